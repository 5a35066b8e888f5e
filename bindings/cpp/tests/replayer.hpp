// SPDX-License-Identifier: BSD-3-Clause
// A scenario that runs in C++: its names, its handles, and one call of it.
#ifndef CAIRN_BINDINGS_CPP_TESTS_REPLAYER_HPP
#define CAIRN_BINDINGS_CPP_TESTS_REPLAYER_HPP

#include <functional>
#include <memory>
#include <set>

#include "values.hpp"

namespace replayer {

/// What the functions of a scenario throw to abort a call.
struct Aborted {};

/// All that a scenario holds. The newest handle is destroyed first.
struct Scenario {
  ~Scenario() {
    while (!owned.empty()) owned.pop_back();
  }

  template <class T>
  T& get(const std::string& name) const {
    const auto found = handles.find(name);
    if (found == handles.end()) throw Failure(name + " is no handle");
    return *static_cast<T*>(found->second);
  }
  template <class T>
  void own(const std::string& name, T handle) {
    auto owner = std::make_shared<T>(std::move(handle));
    handles[name] = owner.get();
    if constexpr (std::is_same_v<T, cairn::Map>) views.insert_or_assign(name, cairn::MapView(*owner));
    owned.push_back(std::move(owner));
    names.set_name(name, name);
  }
  void lend(const std::string& name, const cairn::MapView& map) {
    views.insert_or_assign(name, map);
    names.set_name(name, name);
  }
  const cairn::MapView& view(const std::string& name) const { return views.at(name); }

  conformance::Scenario names;
  std::map<std::string, void*> handles;
  std::map<std::string, cairn::MapView> views;
  std::vector<std::shared_ptr<void>> owned;
  std::vector<std::string> lines;
  std::vector<std::weak_ptr<conformance::Payload>> payloads;
};

class Call {
 public:
  Call(Scenario& scenario_, const json& entry_)
      : scenario(scenario_), entry(entry_), inputs(scenario_.names.resolved(entry_.value("with", json::object()))) {}

  bool has(const char* name) const { return inputs.contains(name); }
  const json& at(const char* name) {
    used.insert(name);
    if (!has(name)) throw Failure(std::string(name) + " is missing");
    return inputs.at(name);
  }
  std::string text(const char* name) { return at(name).get<std::string>(); }

  /// An input. Lists that are missing are empty.
  template <class T>
  T in(const char* name) {
    if constexpr (is_vector<T>) {
      if (!has(name)) return {};
    }
    return as<T>(at(name));
  }
  double number(const char* name) { return in<double>(name); }
  std::vector<double> list(const char* name) { return in<std::vector<double>>(name); }
  std::uint64_t id(const char* name) { return in<std::uint64_t>(name); }
  std::int32_t sensor() { return in<std::int32_t>("sensor"); }

  cairn::Filter& filter() { return scenario.get<cairn::Filter>(text("filter")); }
  cairn::Team& team() { return scenario.get<cairn::Team>(text("team")); }
  cairn::World& world() { return scenario.get<cairn::World>(text("world")); }
  cairn::Fleet& fleet() { return scenario.get<cairn::Fleet>(text("fleet")); }
  const cairn::MapView& map(const char* name = "map") { return scenario.view(text(name)); }

  template <class T>
  void give(const char* name, const T& value) {
    gives[name] = write(value);
  }
  void give_size(const char* name, std::size_t size) { gives[name] = size; }  // an id would be a string
  void give_text(const char* text) { gives["return"] = text; }
  void give_estimate(const cairn::PoseEstimate& estimate) {
    give("pose", estimate.pose);
    give("covariance", estimate.covariance);
  }

  /// The name that the scenario gives to an output.
  std::string name_of(const char* output) const { return entry.at("gives").at(output).get<std::string>(); }
  template <class T>
  void give_created(const char* output, T handle) {
    scenario.own(name_of(output), std::move(handle));
    gives[output] = name_of(output);
  }
  void give_lent(const cairn::MapView& map) {
    scenario.lend(name_of("return"), map);
    gives["return"] = name_of("return");
  }
  /// Closes a handle, as a destroy function does.
  template <class T>
  void close(const char* name) {
    scenario.get<T>(text(name)).close();
  }

  /// The functions of the scenario, which abort by an exception.
  std::shared_ptr<conformance::Payload> payload(const cairn::Custom& custom) {
    auto result = std::make_shared<conformance::Payload>();
    result->predict = text("predict");
    if (has("place")) result->place = text("place");
    result->rows = custom.rows;
    if (!conformance::is_predict(result->predict)) throw Failure(result->predict + " is unknown");
    if (has("place") && !conformance::is_place(result->place)) throw Failure(result->place + " is unknown");
    scenario.payloads.push_back(result);
    return result;
  }

  Scenario& scenario;
  const json& entry;
  json inputs;
  json gives = json::object();
  std::set<std::string> used;
};

inline bool answered(std::int32_t answer) {
  if (answer < 0) throw Aborted();
  return answer != 0;
}

inline auto predict_of(std::shared_ptr<conformance::Payload> payload) {
  return [payload](const cairn::Pose& pose, cairn::Span<const double> landmark, cairn::Prediction& out) {
    return answered(conformance_predict(payload.get(), cairn::detail::as_c(&pose), landmark.data(), out.z.data(),
                                        out.jacobian_pose.data(), out.jacobian_landmark.data()));
  };
}

inline auto place_of(std::shared_ptr<conformance::Payload> payload) {
  return [payload](const cairn::Pose& pose, cairn::Span<const double> z, cairn::Placement& out) {
    return answered(conformance_place(payload.get(), cairn::detail::as_c(&pose), z.data(), out.landmark.data(),
                                      out.jacobian_pose.data(), out.jacobian_z.data()));
  };
}

using Function = std::function<void(Call&)>;
const std::map<std::string, Function>& functions();

}  // namespace replayer

#endif
