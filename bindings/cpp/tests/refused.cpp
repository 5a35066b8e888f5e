// SPDX-License-Identifier: BSD-3-Clause
// Each line that ends with "refused" must not compile; the compiler must complain about it.
#include <Eigen/Core>
#include <cairn/cairn.hpp>

void refused(cairn::Filter& filter, const cairn::Filter& constant, const std::array<double, 2>& two,
             const Eigen::MatrixXd& by_columns, const std::vector<float>& floats) {
  filter.predict_twist(0.1, two, {0, 0, 0});                    // refused
  filter.predict_twist(0.1, Eigen::Vector2d(1, 2), {0, 0, 0});  // refused
  filter.update_linear({1.0}, {1.0}, by_columns, {}, {});       // refused
  filter.predict_twist(0.1, floats, {0, 0, 0});                 // refused
  cairn::Filter copy = filter;                                  // refused
  constant.close_submap();                                      // refused
  filter.map().merge(constant.map());                           // refused
  filter.set_loss(0, 1, 2.0);                                   // refused
  cairn::FilterOptions().join = 2;                              // refused
}
