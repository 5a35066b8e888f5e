// SPDX-License-Identifier: BSD-3-Clause
// Maps: the view of a map, and a map of its own.
#ifndef CAIRN_CPP_MAP_HPP
#define CAIRN_CPP_MAP_HPP

#include <cairn/cpp/handle.hpp>
#include <cairn/cpp/pose.hpp>

namespace cairn {

class Map;

namespace detail {

struct MapKind {
  using Handle = cairn_map;
  static constexpr const char* name = "map";
  //~ cairn_map_destroy
  /// Frees a copy. A map that a filter owns is not freed: it is destroyed with its filter.
  ///
  /// Complexity: O(n).
  static void destroy(Handle* handle) noexcept { cairn_map_destroy(handle); }
};

}  // namespace detail

/// A map that belongs to a Filter, to a Team or to a Map, and follows it. When its owner is closed or destroyed, every
/// call throws an Error. A view is small: copy it.
class MapView {
 public:
  //~ cairn_map_size
  /// Number of landmarks.
  ///
  /// Complexity: O(1).
  std::size_t size() const { return get<std::size_t>(cairn_map_size); }

  //~ cairn_map_landmark
  /// A landmark by its id.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound.
  ///
  /// Complexity: O(1).
  Landmark landmark(std::uint64_t id) const { return get<Landmark>(cairn_map_landmark, id); }

  //~ cairn_map_landmarks
  /// All landmarks, by ascending id.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorBuffer.
  ///
  /// Complexity: O(n log n).
  std::vector<Landmark> landmarks() const { return list<Landmark>(cairn_map_landmarks); }

  //~ cairn_map_within
  /// Landmarks whose estimate lies within `radius` (m, >= 0) of `centre` (map frame, m): nearest first, ties by id.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorBuffer.
  ///
  /// Complexity: O(n + k log k) for k found.
  std::vector<Landmark> within(Vector<3> centre, double radius) const {
    return list<Landmark>(cairn_map_within, centre.get("centre"), radius);
  }

  //~ cairn_map_nearest
  /// The `count` landmarks nearest to `point` (map frame, m): nearest first, ties by id. Fewer if the map holds fewer.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorBuffer.
  ///
  /// Complexity: O(n + k log k).
  std::vector<Landmark> nearest(Vector<3> point, std::size_t count) const {
    return list<Landmark>(cairn_map_nearest, point.get("point"), count);
  }

  //~ cairn_map_in_box
  /// Landmarks whose estimate lies in the closed box between `lower` and `upper` (map frame, m), by ascending id.
  ///
  /// Throws Error: Status::kErrorArgument (also lower > upper); Status::kErrorBuffer.
  ///
  /// Complexity: O(n + k log k).
  std::vector<Landmark> in_box(Vector<3> lower, Vector<3> upper) const {
    return list<Landmark>(cairn_map_in_box, lower.get("lower"), upper.get("upper"));
  }

  //~ cairn_map_joint_covariance
  /// Joint covariance of the positions of chosen landmarks: `matrix` is 3 count x 3 count, row-major, blocks in the
  /// order of `ids`. No id may appear twice.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound; Status::kErrorBuffer.
  ///
  /// Complexity: O(count^2).
  std::vector<double> joint_covariance(Input<std::uint64_t> ids) const {
    return list<double>(cairn_map_joint_covariance, ids.data(), ids.size());
  }

  //~ cairn_map_kind
  /// Kind of a map: MapForm::kDense or MapForm::kSparse.
  ///
  /// Complexity: O(1).
  MapForm kind() const { return static_cast<MapForm>(get<std::int32_t>(cairn_map_kind)); }

  //~ cairn_map_merged_ids
  /// Where the landmarks of the other map are after the last merge into this map, by ascending other_id; none before a
  /// merge. A copy returns the same.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorBuffer.
  ///
  /// Complexity: O(n).
  std::vector<MergedId> merged_ids() const { return list<MergedId>(cairn_map_merged_ids); }

  //~ cairn_map_copy
  /// Makes a copy of the same kind. The copy stays as it is when the filter goes on or is destroyed. All queries work
  /// on it. A copy of a filter's open submap (Filter::local_map) is in the frame of this submap.
  ///
  /// Throws Error: Status::kErrorMemory.
  ///
  /// Complexity: dense O(n^2); sparse O(n): the factor's parts are shared.
  Map copy() const;

 protected:
  friend class Map;
  friend class Filter;
  friend class Team;

  MapView(std::weak_ptr<detail::Guarded> owner, const cairn_map* map, const char* owner_name) noexcept
      : owner_(std::move(owner)), map_(map), owner_name_(owner_name) {}

  /// Keeps the owner alive and unchanged during `function(map)`.
  template <class Function>
  auto with_map(Function function) const {
    const std::shared_ptr<detail::Guarded> owner = owner_.lock();
    if (owner == nullptr) detail::refuse_closed(owner_name_);
    const detail::Reading reading(*owner);
    if (!owner->open) detail::refuse_closed(owner_name_);
    return function(map_);
  }

  template <class T, class Function, class... Arguments>
  T get(Function function, Arguments... arguments) const {
    T result{};
    with_map([&](const cairn_map* map) {
      detail::call(
          [&](cairn_error* error) { return function(map, arguments..., detail::as_c_or_same(&result), error); });
    });
    return result;
  }

  template <class T, class Function, class... Arguments>
  std::vector<T> list(Function function, Arguments... arguments) const {
    return with_map([&](const cairn_map* map) {
      return detail::fill<T>([&](auto* data, std::size_t capacity, std::size_t* needed, cairn_error* error) {
        return function(map, arguments..., data, capacity, needed, error);
      });
    });
  }

 private:
  std::weak_ptr<detail::Guarded> owner_;
  const cairn_map* map_ = nullptr;
  const char* owner_name_ = detail::MapKind::name;
};

/// A map of its own: a copy, which stays as it is, and into which other maps can be merged.
class Map : private detail::Owner<detail::MapKind>, public MapView {
 public:
  using Owner::c_handle;
  using Owner::close;
  using Owner::is_open;

  Map(Map&&) noexcept = default;
  Map& operator=(Map&&) noexcept = default;

  //~ cairn_map_merge
  /// Merges the landmarks of `other` into `map`. `map` stays in its own frame. The merge finds the transform between
  /// both frames from the common landmarks (with has_transform also from the transform that the caller knows).
  /// Afterwards `map` holds the best estimate that follows from both maps (docs/map_merging.md). A call that fails
  /// changes neither map.
  ///
  /// Ids of `map` never change. A common landmark keeps the id that it has in `map`. An added landmark keeps its id. By
  /// geometry, an added landmark whose id is already used in `map` gets the smallest free id above all ids of both
  /// maps; if there is none, the smallest free id. MapView::merged_ids returns all new ids.
  ///
  /// The maps must come from independent data. Two copies of one filter's map, or a merged map and one of its parts,
  /// are refused, because the data that they share would count twice. Information of a sparse `other` about its own
  /// frame (start pose, absolute observations) is not merged. With has_transform its start pose is merged.
  ///
  /// `map` must be a copy. `other` may be a copy or a filter's map. `options` may be none for the defaults. It is also
  /// filled in if the merge is refused because of the contents of the maps.
  ///
  /// Throws Error: Status::kErrorArgument (also map == other); Status::kErrorState (`map` belongs to a filter: copy it;
  /// the kinds differ; both hold landmarks of the same filter; a sparse `other` was itself merged with has_transform:
  /// merge the other way round); Status::kErrorNotFound (a map is empty, or there are too few common landmarks: with
  /// has_transform one is necessary, without it three); Status::kErrorNumerical (the common landmarks lie on a line;
  /// they contradict each other, and message and report name the worst pair; by geometry: more than one transform
  /// fits); Status::kErrorCapacity (max_landmarks); Status::kErrorMemory.
  ///
  /// Complexity: for n landmarks in both maps and k common ones: dense O(n^2 k + k^3); sparse: that of closing all
  /// submaps of `other` at once, plus the joint test of at most 300 common landmarks. By geometry additionally O(n log
  /// n) and the search among triangles, which has a budget.
  MergeReport merge(const MapView& other, const MergeOptions& options = {}) {
    MergeReport report;
    merge(other, options, report);
    return report;
  }

  /// The same. `report` is also filled in if the merge is refused because of the contents of the maps.
  void merge(const MapView& other, const MergeOptions& options, MergeReport& report) {
    report = MergeReport{};
    const auto merge_one = [&](const cairn_map* from) {
      change(cairn_map_merge, from, detail::as_c(&options), detail::as_c(&report));
    };
    if (other.map_ == c_handle()) {
      merge_one(other.map_);  // the library refuses it
    } else {
      other.with_map(merge_one);
    }
  }

 private:
  friend class MapView;

  template <class Create>
  explicit Map(Create create) : Owner(create), MapView(Owner::shared(), c_handle(), detail::MapKind::name) {}
};

inline Map MapView::copy() const {
  return with_map([](const cairn_map* map) {
    return Map([&](cairn_map** copy, cairn_error* error) { return cairn_map_copy(map, copy, error); });
  });
}

}  // namespace cairn

#endif
