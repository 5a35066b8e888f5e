// SPDX-License-Identifier: BSD-3-Clause
// The sparse factor against a dense inverse, as leaves come, grow and share more and more variables.
#include "map/join/sparse/elimination_tree.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <set>

#include "numerical.hpp"

namespace {

using namespace cairn;
using cairn::test::Random;
using Matrix = Eigen::MatrixXd;

struct Block {
  TreeKey key;
  std::vector<Variable> variables;  // ascending
  Matrix information;
};

// Leaves, and all of them in one dense matrix.
template <class Pose>
class Leaves final : public LeafSource {
 public:
  std::vector<Block> blocks;
  bool relative = false;  // all but the first know differences alone

  bool absolute(std::uint32_t leaf) const override { return !relative || leaf == 0; }
  const std::vector<Variable>& variables(std::uint32_t leaf) const override { return blocks[leaf].variables; }
  void information(std::uint32_t leaf, double* H, Index ld) const override {
    const Matrix& own = blocks[leaf].information;
    for (Eigen::Index c = 0; c < own.cols(); ++c)
      for (Eigen::Index r = c; r < own.rows(); ++r) H[c * ld + r] = own(r, c);
  }
  std::map<Variable, Eigen::Index> states() const {
    std::map<Variable, Eigen::Index> at;
    for (const Block& block : blocks)
      for (const Variable v : block.variables) at[v] = 0;
    Eigen::Index next = 0;
    for (auto& [v, state] : at) {
      state = next;
      next += dimension<Pose>(v);
    }
    return at;
  }
  std::vector<Eigen::Index> states_of(const Block& block) const {
    const auto at = states();
    std::vector<Eigen::Index> out;
    for (const Variable v : block.variables)
      for (Index d = 0; d < dimension<Pose>(v); ++d) out.push_back(at.at(v) + d);
    return out;
  }
  Matrix inverse() const {
    const auto at = states();
    const Eigen::Index n = at.rbegin()->second + dimension<Pose>(at.rbegin()->first);
    Matrix H = Matrix::Zero(n, n);
    for (const Block& block : blocks) {
      const std::vector<Eigen::Index> own = states_of(block);
      H(own, own) += block.information;
    }
    return H.ldlt().solve(Matrix::Identity(n, n));
  }
  std::int32_t degree(Variable v) const {
    std::int32_t count = 0;
    for (const Block& block : blocks)
      count += std::binary_search(block.variables.begin(), block.variables.end(), v) ? 1 : 0;
    return count;
  }
};

// Right-hand sides and solutions as dense columns.
template <class Pose>
class Columns final : public EliminationTree<Pose>::System {
 public:
  Columns(std::map<Variable, Eigen::Index> states, Matrix b, bool go_on)
      : solution_(Matrix::Zero(b.rows(), b.cols())), states_(std::move(states)), b_(std::move(b)), go_on_(go_on) {}

  void right_hand_side(Variable v, double* b, Index ld) const override {
    for (Eigen::Index c = 0; c < b_.cols(); ++c)
      for (Index d = 0; d < dimension<Pose>(v); ++d) b[c * ld + d] += b_(states_.at(v) + d, c);
  }
  bool solution(Variable v, const double* x, Index ld) override {
    for (Eigen::Index c = 0; c < b_.cols(); ++c)
      for (Index d = 0; d < dimension<Pose>(v); ++d) solution_(states_.at(v) + d, c) = x[c * ld + d];
    CHECK(visited.insert(v).second);  // once each
    return go_on_;
  }

  Matrix solution_;
  std::set<Variable> visited;

 private:
  std::map<Variable, Eigen::Index> states_;
  Matrix b_;
  bool go_on_;
};

template <class Pose>
class Blocks final : public EliminationTree<Pose>::Covariances {
 public:
  void leaf(std::uint32_t leaf, const Matrix& covariance) override { CHECK(of.emplace(leaf, covariance).second); }
  std::map<std::uint32_t, Matrix> of;
};

// How all go along with a shift: a column for each of its directions.
template <class Pose>
Matrix shifts(const std::vector<Variable>& variables) {
  Matrix columns = Matrix::Zero(dimension<Pose>(variables), Pose::kDim);
  Index row = 0;
  for (const Variable v : variables) {
    columns.middleRows<Pose::kDim>(row).setIdentity();
    row += dimension<Pose>(v);
  }
  return columns;
}

// Leaves that pull towards a point each: values of all variables, and the force of each leaf where it was last looked
// at.
template <class Pose>
class Springs final : public EliminationTree<Pose>::Relaxation {
 public:
  using RigidMotion = typename EliminationTree<Pose>::RigidMotion;

  explicit Springs(const Leaves<Pose>& leaves) : leaves_(leaves) {}

  double tolerance = 0.0;
  std::map<Variable, Matrix> values;
  std::vector<std::uint32_t> visited;
  std::size_t carried = 0;  // leaves

  void pull(std::uint32_t leaf, Matrix target) {
    targets_[leaf] = std::move(target);
    for (const Variable v : leaves_.blocks[leaf].variables) values.emplace(v, Matrix::Zero(dimension<Pose>(v), 1));
    look_at(leaf);
  }
  Matrix at(std::uint32_t leaf) const {
    const Block& block = leaves_.blocks[leaf];
    Matrix x(dimension<Pose>(block.variables), 1);
    Index row = 0;
    for (const Variable v : block.variables) {
      x.middleRows(row, dimension<Pose>(v)) = values.at(v);
      row += dimension<Pose>(v);
    }
    return x;
  }
  void look_at(std::uint32_t leaf) {
    forces_[leaf] = leaves_.blocks[leaf].information * (targets_.at(leaf) - at(leaf));
  }
  double cost() const {
    double sum = 0.0;
    for (const auto& [leaf, target] : targets_) {
      const Matrix stretch = target - at(leaf);
      sum += 0.5 * (stretch.transpose() * leaves_.blocks[leaf].information * stretch).value();
    }
    return sum;
  }
  Matrix solution() const {
    const auto states = leaves_.states();
    const Matrix inverse = leaves_.inverse();
    Matrix b = Matrix::Zero(inverse.rows(), 1);
    for (const auto& [leaf, target] : targets_)
      b(leaves_.states_of(leaves_.blocks[leaf]), Eigen::all) += leaves_.blocks[leaf].information * target;
    return inverse * b;
  }
  Matrix value() const {
    Matrix x(leaves_.inverse().rows(), 1);
    for (const auto& [v, state] : leaves_.states()) x.middleRows(state, dimension<Pose>(v)) = values.at(v);
    return x;
  }

  void right_hand_side(Variable v, double* b, Index) const override {
    for (const auto& [leaf, force] : forces_) {
      Index at = 0;
      for (const Variable u : leaves_.blocks[leaf].variables) {
        if (u == v)
          for (Index d = 0; d < dimension<Pose>(v); ++d) b[d] += force(at + d);
        at += dimension<Pose>(u);
      }
    }
  }
  bool solution(Variable v, const double* x, Index) override {
    values.at(v) += Eigen::Map<const Matrix>(x, dimension<Pose>(v), 1);
    return true;
  }
  bool matters(Variable v, const double* x) const override {
    return Eigen::Map<const Matrix>(x, dimension<Pose>(v), 1).norm() >= tolerance;
  }
  // No more than a shift: there is no geometry here.
  RigidMotion take_rigid(const std::vector<Variable>& variables, Eigen::VectorXd& motion) const override {
    using Point = typename Pose::Point;
    RigidMotion rigid{Point::Zero(), Point::Zero(), Pose::Rotation::Tangent::Zero()};
    const Matrix shift = shifts<Pose>(variables);
    rigid.move = shift.transpose() * motion / static_cast<double>(variables.size());
    motion -= shift * rigid.move;
    return rigid;
  }
  void carry(Variable v, const RigidMotion& motion) override {
    values.at(v).template topRows<Pose::kDim>() += motion.move;
  }
  void carry_leaf(std::uint32_t leaf, const RigidMotion&) override {
    CHECK(!leaves_.absolute(leaf));
    ++carried;
  }
  void visit(std::uint32_t leaf) override {
    look_at(leaf);
    visited.push_back(leaf);
  }

 private:
  const Leaves<Pose>& leaves_;
  std::map<std::uint32_t, Matrix> targets_, forces_;
};

double difference(const Matrix& a, const Matrix& b) {
  return (a - b).norm() / (1e-300 + b.norm());
}

template <class Pose>
class Growth {
 public:
  explicit Growth(unsigned seed) : random_(seed) {}

  Leaves<Pose> leaves;
  EliminationTree<Pose> tree;
  std::size_t refactored = 0;
  Springs<Pose>* springs = nullptr;  // what is settled before each change
  double foreseen = 0.0;             // by the last relax()

  // Another leaf somewhere: its two bases, landmarks of its own neighbourhood, known ones and new ones, and now and
  // then one that some old leaf has had to itself so far.
  void add(const Vector3& place, int known, int fresh, bool one_of_an_old_leaf) {
    const auto number = static_cast<std::uint32_t>(leaves.blocks.size());
    TreeChanges changes;
    std::vector<Variable> variables{base_variable(number), base_variable(number + 1)};
    const auto hold = [&](Variable v) {
      if (std::find(variables.begin(), variables.end(), v) == variables.end()) variables.push_back(v);
    };
    for (int i = 0; i < known && landmarks_ > 0; ++i) hold(landmark_variable(below(landmarks_)));
    for (int i = 0; i < fresh; ++i) hold(landmark_variable(landmarks_++));
    if (one_of_an_old_leaf && number > 0) {
      Block& old = leaves.blocks[below(number)];
      const Variable v = landmark_variable(landmarks_++);
      hold(v);
      old.variables.push_back(v);
      std::sort(old.variables.begin(), old.variables.end());
      old.information = information(old.variables);
      changes.leaves.push_back(old.key);
    }
    std::sort(variables.begin(), variables.end());
    for (const Variable v : variables)
      for (const Block& block : leaves.blocks)
        if (std::binary_search(block.variables.begin(), block.variables.end(), v)) {
          changes.variables.emplace_back(v, block.key);
          break;
        }
    leaves.blocks.push_back({TreeKey(place, number), variables, information(variables)});
    changes.leaves.push_back(leaves.blocks.back().key);
    for (const Variable v : variables) tree.set_degree(v, leaves.degree(v));
    tree.set_degree(base_variable(number + 1), 2);  // the next leaf begins there
    std::vector<std::uint32_t> assembled;
    if (springs != nullptr) {
      tree.settle(changes, *springs);
      for (const TreeKey& key : changes.leaves) springs->visited.push_back(key.leaf);
      for (const auto& [v, key] : changes.variables) springs->visited.push_back(key.leaf);
    }
    REQUIRE(tree.update(leaves, changes, refactored, assembled));
    CHECK(std::find(assembled.begin(), assembled.end(), number) != assembled.end());
  }

  // One step from all that was evaluated or named since the last; returns how many it visits.
  std::size_t relax() {
    std::vector<TreeTouch> touches;
    for (const std::uint32_t leaf : springs->visited) touches.push_back(tree.touch(leaves.blocks[leaf].key));
    springs->visited.clear();
    foreseen = tree.relax(touches, *springs);
    return springs->visited.size();
  }

  Matrix information(const std::vector<Variable>& variables) {
    const Index n = dimension<Pose>(variables);
    Matrix J(n + 2, n);
    for (Eigen::Index i = 0; i < J.size(); ++i) J.data()[i] = random_.normal();
    Matrix all = J.transpose() * J + 0.1 * Matrix::Identity(n, n);
    if (!leaves.relative || leaves.blocks.empty()) return all;
    const Matrix shift = shifts<Pose>(variables);
    const Matrix differences =
        Matrix::Identity(n, n) - shift * shift.transpose() / static_cast<double>(variables.size());
    return differences * all * differences;
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_.uniform(0, static_cast<double>(n))); }
  Vector3 anywhere(double extent) {
    return Vector3(random_.uniform(-extent, extent), random_.uniform(-extent, extent), random_.uniform(-2, 2));
  }
  Matrix columns(Eigen::Index n, Eigen::Index count) {
    Matrix b(n, count);
    for (Eigen::Index i = 0; i < b.size(); ++i) b.data()[i] = random_.normal();
    return b;
  }

 private:
  Random random_;
  std::size_t landmarks_ = 0;
};

// Everything that a tree can be asked, against the dense inverse of what it was told.
template <class Pose>
void check(const EliminationTree<Pose>& tree, const Leaves<Pose>& leaves, Growth<Pose>& growth) {
  const Matrix inverse = leaves.inverse();
  const auto states = leaves.states();
  std::vector<TreeTouch> all;
  std::vector<TreeKey> keys;
  for (const Block& block : leaves.blocks) {
    all.push_back(tree.touch(block.key));
    keys.push_back(block.key);
  }
  const Matrix b = growth.columns(inverse.rows(), 3);
  Columns<Pose> whole(states, b, true);
  tree.solve(all, 3, whole);
  CHECK(difference(whole.solution_, inverse * b) <= 1e-9);
  CHECK(whole.visited.size() == states.size());

  // One variable's columns, touched where it was eliminated and nowhere else.
  const Block& block = leaves.blocks[growth.below(leaves.blocks.size())];
  const Variable v = block.variables[growth.below(block.variables.size())];
  const Eigen::Index at = states.at(v), d = dimension<Pose>(v);
  const Matrix unit = Matrix::Identity(inverse.rows(), inverse.rows()).middleCols(at, d);
  Columns<Pose> column(states, unit, true);
  tree.solve({tree.touch(v, block.key)}, d, column);
  CHECK(difference(column.solution_, inverse.middleCols(at, d)) <= 1e-9);
  Columns<Pose> path(states, unit, false);  // what is visited all the same
  tree.solve({tree.touch(v, block.key)}, d, path);
  CHECK(path.visited.count(v) == 1);
  for (const Variable u : path.visited)
    CHECK(difference(path.solution_.middleRows(states.at(u), dimension<Pose>(u)),
                     inverse.block(states.at(u), at, dimension<Pose>(u), d)) <= 1e-8);

  Blocks<Pose> blocks;
  tree.covariances(keys, blocks);
  REQUIRE(blocks.of.size() == leaves.blocks.size());
  for (std::uint32_t i = 0; i < leaves.blocks.size(); ++i) {
    const std::vector<Eigen::Index> own = leaves.states_of(leaves.blocks[i]);
    CHECK(difference(blocks.of.at(i), inverse(own, own)) <= 1e-9);
  }
  Blocks<Pose> alone;
  tree.covariances({block.key}, alone);
  REQUIRE(alone.of.size() == 1);
  CHECK(alone.of.begin()->second == blocks.of.at(block.key.leaf));  // whatever else is asked for

  const Eigen::Index newest = states.at(base_variable(leaves.blocks.size()));
  CHECK(difference(tree.last_covariance(), inverse.block<Pose::kDof, Pose::kDof>(newest, newest)) <= 1e-9);
}

}  // namespace

TEST_CASE_TEMPLATE("elimination tree: equal to a dense inverse while it grows", Pose, SE3, SE2) {
  SUBCASE("places anywhere, landmarks of anywhere") {
    Growth<Pose> growth(1);
    for (int i = 0; i < 24; ++i) {
      growth.add(growth.anywhere(300), i % 4, 1 + i % 3, i % 3 == 2);
      check(growth.tree, growth.leaves, growth);
    }
  }
  SUBCASE("all in one cell") {
    Growth<Pose> growth(2);
    for (int i = 0; i < 12; ++i) {
      growth.add(Vector3(0.5, 0.5, 0.5), 3, 2, i % 2 == 1);
      check(growth.tree, growth.leaves, growth);
    }
  }
  SUBCASE("along a line, and home again") {
    Growth<Pose> growth(3);
    for (int i = 0; i < 20; ++i) {
      growth.add(Vector3(i < 10 ? 40.0 * i : 40.0 * (19 - i), 0, 0), 2, 2, false);
      check(growth.tree, growth.leaves, growth);
    }
  }
  SUBCASE("farther out than there are cells") {
    Growth<Pose> growth(4);
    for (const double x : {0.0, 1e5, -1e7, 1e9, 1e300, -1e300}) {
      growth.add(Vector3(x, -x, x), 2, 2, true);
      check(growth.tree, growth.leaves, growth);
    }
  }
}

TEST_CASE_TEMPLATE("elimination tree: a copy is a tree of its own", Pose, SE3, SE2) {
  Growth<Pose> growth(5);
  for (int i = 0; i < 10; ++i) growth.add(growth.anywhere(100), 3, 2, i % 2 == 0);
  const EliminationTree<Pose> copy = growth.tree;
  const Leaves<Pose> before = growth.leaves;
  for (int i = 0; i < 6; ++i) growth.add(growth.anywhere(100), 3, 2, true);
  check(copy, before, growth);
  check(growth.tree, growth.leaves, growth);
  growth.tree = copy;
  growth.leaves = before;
  growth.add(growth.anywhere(100), 4, 1, true);  // and goes on by itself
  check(growth.tree, growth.leaves, growth);
}

TEST_CASE_TEMPLATE("elimination tree: motions that were kept are never lost", Pose, SE3, SE2) {
  for (unsigned seed = 10; seed < 16; ++seed) {
    CAPTURE(seed);
    Growth<Pose> growth(seed);
    Springs<Pose> springs(growth.leaves);
    growth.springs = &springs;
    std::size_t spared = 0;
    for (std::uint32_t i = 0; i < 60; ++i) {
      // Old leaves keep their variables here: what a leaf pulls towards stays as it is.
      growth.add(growth.anywhere(seed % 2 == 0 ? 100 : 1000), static_cast<int>(i % 3), 2, false);
      springs.pull(i, growth.columns(dimension<Pose>(growth.leaves.blocks[i].variables), 1));
      springs.tolerance = 0.3;
      spared += i + 1 - growth.relax();
      if (i % 12 != 11) continue;
      springs.tolerance = 0.0;  // all of it, now
      CHECK(growth.relax() == i + 1);
      CHECK(difference(springs.value(), springs.solution()) <= 1e-9);
    }
    CHECK(spared > 300);  // of 1830
  }
}

TEST_CASE_TEMPLATE("elimination tree: what is carried along is never lost either", Pose, SE3, SE2) {
  for (unsigned seed = 30; seed < 36; ++seed) {
    CAPTURE(seed);
    Growth<Pose> growth(seed);
    growth.leaves.relative = true;
    Springs<Pose> springs(growth.leaves);
    growth.springs = &springs;
    for (std::uint32_t i = 0; i < 60; ++i) {
      growth.add(growth.anywhere(seed % 2 == 0 ? 100 : 1000), static_cast<int>(i % 3), 2, false);
      springs.pull(i, 0.01 * growth.columns(dimension<Pose>(growth.leaves.blocks[i].variables), 1));
      // The first leaf is the only one that knows where all are: the rest follows it.
      if (i % 6 == 5) springs.pull(0, shifts<Pose>(growth.leaves.blocks[0].variables) * growth.columns(Pose::kDim, 1));
      if (i % 6 == 5) springs.visited.push_back(0);
      springs.tolerance = 0.3;
      growth.relax();
      if (i % 12 != 11) continue;
      springs.tolerance = 0.0;
      growth.relax();
      CHECK(difference(springs.value(), springs.solution()) <= 1e-8);
    }
    CHECK(springs.carried > 60);
  }
}

TEST_CASE_TEMPLATE("elimination tree: the fall of a quadratic cost is foretold", Pose, SE3, SE2) {
  for (unsigned seed = 20; seed < 24; ++seed) {
    CAPTURE(seed);
    Growth<Pose> growth(seed);
    Springs<Pose> springs(growth.leaves);
    growth.springs = &springs;
    for (std::uint32_t i = 0; i < 30; ++i) {
      growth.add(growth.anywhere(100), static_cast<int>(i % 3), 2, false);
      springs.pull(i, growth.columns(dimension<Pose>(growth.leaves.blocks[i].variables), 1));
      const double before = springs.cost();
      growth.relax();
      CHECK(growth.foreseen > 0.0);
      CHECK(std::abs(before - springs.cost() - growth.foreseen) <= 1e-10 * before);
    }
  }
}

TEST_CASE_TEMPLATE("elimination tree: an update that fails changes nothing", Pose, SE3, SE2) {
  Growth<Pose> growth(6);
  for (int i = 0; i < 10; ++i) growth.add(growth.anywhere(100), 3, 2, i % 2 == 0);
  const Leaves<Pose> before = growth.leaves;
  Blocks<Pose> expected, actual;
  std::vector<TreeKey> keys;
  for (const Block& block : before.blocks) keys.push_back(block.key);
  growth.tree.covariances(keys, expected);
  growth.leaves.blocks[4].information *= -100.0;
  std::size_t refactored = 4711;
  std::vector<std::uint32_t> assembled;
  CHECK(!growth.tree.update(growth.leaves, {{keys[4]}, {}}, refactored, assembled));
  CHECK(refactored == 4711);
  growth.tree.covariances(keys, actual);
  CHECK(actual.of == expected.of);
  growth.leaves = before;
  CHECK(growth.tree.update(growth.leaves, {{keys[4]}, {}}, refactored, assembled));
  check(growth.tree, growth.leaves, growth);
}

TEST_CASE_TEMPLATE("elimination tree: nothing to change, nothing to ask", Pose, SE3, SE2) {
  EliminationTree<Pose> tree;
  Leaves<Pose> none;
  std::size_t refactored = 0;
  std::vector<std::uint32_t> assembled;
  CHECK(tree.update(none, {}, refactored, assembled));
  CHECK(tree.memory_bytes() == 0);
  Columns<Pose> columns({}, Matrix(0, 1), true);
  tree.solve({}, 1, columns);
  CHECK(columns.visited.empty());
}

TEST_CASE_TEMPLATE("elimination tree: a change reaches one path", Pose, SE3, SE2) {
  Growth<Pose> growth(7);
  for (int i = 0; i < 40; ++i) growth.add(Vector3(30.0 * i, 0, 0), 0, 3, false);
  std::size_t refactored = 0;
  std::vector<std::uint32_t> assembled;
  const Block& block = growth.leaves.blocks[17];
  REQUIRE(growth.tree.update(growth.leaves, {{block.key}, {}}, refactored, assembled));
  CHECK(refactored >= 3);
  CHECK(refactored <= 12);       // of 40: the trie's depth and the crown
  CHECK(assembled.size() <= 2);  // its own leaf, and at most the sibling's
  check(growth.tree, growth.leaves, growth);
}

TEST_CASE("tree key: splits, bits and order agree") {
  Random random(8);
  std::vector<TreeKey> keys;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const double extent = i < 20 ? 2 : i < 40 ? 500 : 3e6;
    keys.emplace_back(extent * random.normal_vector<3>(), i);
    keys.emplace_back(Vector3(0, 0, 0), 1000 + i);
  }
  for (const TreeKey& a : keys)
    for (const TreeKey& b : keys) {
      const int split = a.split(b);
      CHECK(split == b.split(a));
      if (&a == &b) {
        CHECK(split == TreeKey::kBits);
        CHECK(!(a < b));
        continue;
      }
      REQUIRE(split < TreeKey::kBits);
      for (int i = 0; i < split; ++i) CHECK(a.bit(i) == b.bit(i));
      CHECK(a.bit(split) != b.bit(split));
      CHECK((a < b) == b.bit(split));
    }
}

TEST_CASE("tree key: neighbours are parted late") {
  // Two places 1 m apart may stand on two sides of a wall, but not of a large cell's near the origin.
  for (const double x : {0.0, -3.0, 5.0, 20.0}) {
    const TreeKey a(Vector3(x, 1, 0), 1), b(Vector3(x + 1, 1, 0), 2), far(Vector3(x + 4000, 1, 0), 3);
    CHECK(a.split(b) > a.split(far));
    CHECK(a.split(b) >= 63 - 3 * 6);
  }
}
