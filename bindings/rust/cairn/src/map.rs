// SPDX-License-Identifier: BSD-3-Clause
//! Maps: borrowed from a filter or a team, or copies of the caller's own.
use crate::arrays::{fill, first, gather, get};
use crate::error::{call, Result};
use crate::{Landmark, MapForm, MergeOptions, MergeReport, MergedId};
use cairn_sys as sys;
use std::fmt;
use std::ops::Deref;
use std::ptr::{null, null_mut, NonNull};

/// Landmarks in one frame with their joint uncertainty. A filter or a team lends its map; [`Map::copy`] makes a
/// [`MapCopy`], which can be kept and merged.
#[repr(transparent)]
pub struct Map(sys::cairn_map);

// SAFETY: const queries of a handle may run side by side, and Map has no other functions.
unsafe impl Sync for Map {}

/// A map of the caller's own. It does not follow the filter, and other maps can be merged into it.
///
/// The map of a filter cannot be changed, and a map cannot be merged with itself:
///
/// ```compile_fail,E0599
/// let filter = cairn::Filter::new(&Default::default()).unwrap();
/// let copy = filter.map().copy().unwrap();
/// filter.map().merge(&copy, None);
/// ```
///
/// ```compile_fail,E0502
/// let filter = cairn::Filter::new(&Default::default()).unwrap();
/// let mut copy = filter.map().copy().unwrap();
/// copy.merge(&copy, None);
/// ```
pub struct MapCopy(NonNull<sys::cairn_map>);

// SAFETY: a handle belongs to no thread.
unsafe impl Send for MapCopy {}
// SAFETY: const queries of a handle may run side by side; changes take &mut self.
unsafe impl Sync for MapCopy {}

impl Map {
    /// # Safety
    ///
    /// `map` is a handle that lives, unchanged, for the lifetime of the result.
    pub(crate) unsafe fn borrowed<'a>(map: *const sys::cairn_map) -> &'a Map {
        // SAFETY: Map is transparent, and no value of it can be moved or copied.
        unsafe { &*map.cast::<Map>() }
    }

    fn c(&self) -> *const sys::cairn_map {
        &self.0
    }

    //~ cairn_map_size
    /// Number of landmarks.
    ///
    /// Complexity: O(1).
    pub fn size(&self) -> Result<usize> {
        // SAFETY: a number is written.
        get(|count, error| unsafe { sys::cairn_map_size(self.c(), count, error) })
    }

    //~ cairn_map_kind
    /// Kind of a map: [`MapForm::DENSE`](crate::MapForm::DENSE) or [`MapForm::SPARSE`](crate::MapForm::SPARSE).
    ///
    /// Complexity: O(1).
    pub fn kind(&self) -> Result<MapForm> {
        // SAFETY: a number is written.
        get(|kind, error| unsafe { sys::cairn_map_kind(self.c(), kind, error) }).map(MapForm)
    }

    //~ cairn_map_landmark
    /// A landmark by its id.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND)
    pub fn landmark(&self, id: u64) -> Result<Landmark> {
        // SAFETY: a landmark is written, which has the layout of Landmark.
        get(|landmark: *mut Landmark, error| unsafe { sys::cairn_map_landmark(self.c(), id, landmark.cast(), error) })
    }

    //~ cairn_map_landmarks
    /// All landmarks, by ascending id.
    ///
    /// Complexity: O(n log n).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn landmarks(&self) -> Result<Vec<Landmark>> {
        gather(|landmarks| self.landmarks_into(landmarks))
    }

    /// [`Map::landmarks`] into memory of the caller.
    ///
    /// # Errors
    ///
    /// As [`Map::landmarks`].
    pub fn landmarks_into(&self, landmarks: &mut Vec<Landmark>) -> Result<()> {
        // SAFETY: the library writes at most `capacity` landmarks, which have the layout of Landmark.
        fill(landmarks, |first: *mut Landmark, capacity, needed, error| unsafe {
            sys::cairn_map_landmarks(self.c(), first.cast(), capacity, needed, error)
        })
    }

    //~ cairn_map_within
    /// Landmarks whose estimate lies within `radius` (m, >= 0) of `centre` (map frame, m): nearest first, ties by id.
    ///
    /// Complexity: O(n + k log k) for k found.
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn within(&self, centre: &[f64; 3], radius: f64) -> Result<Vec<Landmark>> {
        gather(|landmarks| self.within_into(centre, radius, landmarks))
    }

    /// [`Map::within`] into memory of the caller.
    ///
    /// # Errors
    ///
    /// As [`Map::within`].
    pub fn within_into(&self, centre: &[f64; 3], radius: f64, landmarks: &mut Vec<Landmark>) -> Result<()> {
        // SAFETY: as in `landmarks_into`.
        fill(landmarks, |first: *mut Landmark, capacity, needed, error| unsafe {
            sys::cairn_map_within(self.c(), centre.as_ptr(), radius, first.cast(), capacity, needed, error)
        })
    }

    //~ cairn_map_nearest
    /// The `count` landmarks nearest to `point` (map frame, m): nearest first, ties by id. Fewer if the map holds
    /// fewer.
    ///
    /// Complexity: O(n + k log k).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn nearest(&self, point: &[f64; 3], count: usize) -> Result<Vec<Landmark>> {
        gather(|landmarks| self.nearest_into(point, count, landmarks))
    }

    /// [`Map::nearest`] into memory of the caller.
    ///
    /// # Errors
    ///
    /// As [`Map::nearest`].
    pub fn nearest_into(&self, point: &[f64; 3], count: usize, landmarks: &mut Vec<Landmark>) -> Result<()> {
        // SAFETY: as in `landmarks_into`.
        fill(landmarks, |first: *mut Landmark, capacity, needed, error| unsafe {
            sys::cairn_map_nearest(self.c(), point.as_ptr(), count, first.cast(), capacity, needed, error)
        })
    }

    //~ cairn_map_in_box
    /// Landmarks whose estimate lies in the closed box between `lower` and `upper` (map frame, m), by ascending id.
    ///
    /// Complexity: O(n + k log k).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT): also lower > upper
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn in_box(&self, lower: &[f64; 3], upper: &[f64; 3]) -> Result<Vec<Landmark>> {
        gather(|landmarks| self.in_box_into(lower, upper, landmarks))
    }

    /// [`Map::in_box`] into memory of the caller.
    ///
    /// # Errors
    ///
    /// As [`Map::in_box`].
    pub fn in_box_into(&self, lower: &[f64; 3], upper: &[f64; 3], landmarks: &mut Vec<Landmark>) -> Result<()> {
        // SAFETY: as in `landmarks_into`.
        fill(landmarks, |first: *mut Landmark, capacity, needed, error| unsafe {
            sys::cairn_map_in_box(self.c(), lower.as_ptr(), upper.as_ptr(), first.cast(), capacity, needed, error)
        })
    }

    //~ cairn_map_joint_covariance
    /// Joint covariance of the positions of chosen landmarks: `matrix` is 3 count x 3 count, row-major, blocks in the
    /// order of `ids`. No id may appear twice.
    ///
    /// Complexity: O(count^2).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn joint_covariance(&self, ids: &[u64]) -> Result<Vec<f64>> {
        gather(|matrix| self.joint_covariance_into(ids, matrix))
    }

    /// [`Map::joint_covariance`] into memory of the caller.
    ///
    /// # Errors
    ///
    /// As [`Map::joint_covariance`].
    pub fn joint_covariance_into(&self, ids: &[u64], matrix: &mut Vec<f64>) -> Result<()> {
        // SAFETY: the library writes at most `capacity` values.
        fill(matrix, |start, capacity, needed, error| unsafe {
            sys::cairn_map_joint_covariance(self.c(), first(ids), ids.len(), start, capacity, needed, error)
        })
    }

    //~ cairn_map_merged_ids
    /// Where the landmarks of the other map are after the last merge into this map, by ascending other_id; none before
    /// a merge. A copy returns the same.
    ///
    /// Complexity: O(n).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn merged_ids(&self) -> Result<Vec<MergedId>> {
        let merged = gather(|merged| {
            // SAFETY: the library writes at most `capacity` elements.
            fill(merged, |first, capacity, needed, error| unsafe {
                sys::cairn_map_merged_ids(self.c(), first, capacity, needed, error)
            })
        })?;
        Ok(merged.iter().map(MergedId::from_c).collect())
    }

    //~ cairn_map_copy
    /// Makes a copy of the same kind. The copy stays as it is when the filter goes on or is destroyed. All queries work
    /// on it. A copy of a filter's open submap ([`Filter::local_map`](crate::Filter::local_map)) is in the frame of
    /// this submap.
    ///
    /// Complexity: dense O(n^2); sparse O(n): the factor's parts are shared.
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    pub fn copy(&self) -> Result<MapCopy> {
        let mut copy = null_mut();
        // SAFETY: a call that succeeds has written a handle.
        call(|error| unsafe { sys::cairn_map_copy(self.c(), &mut copy, error) })?;
        // SAFETY: as above.
        Ok(MapCopy(unsafe { NonNull::new_unchecked(copy) }))
    }
}

impl MapCopy {
    //~ cairn_map_merge
    /// Merges the landmarks of `other` into `map`. `map` stays in its own frame. The merge finds the transform between
    /// both frames from the common landmarks (with has_transform also from the transform that the caller knows).
    /// Afterwards `map` holds the best estimate that follows from both maps (docs/map_merging.md). A call that fails
    /// changes neither map.
    ///
    /// Ids of `map` never change. A common landmark keeps the id that it has in `map`. An added landmark keeps its id.
    /// By geometry, an added landmark whose id is already used in `map` gets the smallest free id above all ids of both
    /// maps; if there is none, the smallest free id. [`Map::merged_ids`](crate::Map::merged_ids) returns all new ids.
    ///
    /// The maps must come from independent data. Two copies of one filter's map, or a merged map and one of its parts,
    /// are refused, because the data that they share would count twice. Information of a sparse `other` about its own
    /// frame (start pose, absolute observations) is not merged. With has_transform its start pose is merged.
    ///
    /// `map` must be a copy. `other` may be a copy or a filter's map. `options` may be `None` for the defaults. It is
    /// also filled in if the merge is refused because of the contents of the maps.
    ///
    /// Complexity: for n landmarks in both maps and k common ones: dense O(n^2 k + k^3); sparse: that of closing all
    /// submaps of `other` at once, plus the joint test of at most 300 common landmarks. By geometry additionally O(n
    /// log n) and the search among triangles, which has a budget.
    ///
    //~
    /// In Rust `map` is this copy. [`MapCopy::merge_into`] fills in the report of a refused merge, too.
    //~ errors
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT): also map == other
    /// - [`Status::ERROR_STATE`](crate::Status::ERROR_STATE): `map` belongs to a filter: copy it; the kinds differ;
    ///   both hold landmarks of the same filter; a sparse `other` was itself merged with has_transform: merge the other
    ///   way round
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND): a map is empty, or there are too few common
    ///   landmarks: with has_transform one is necessary, without it three
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL): the common landmarks lie on a line; they
    ///   contradict each other, and message and report name the worst pair; by geometry: more than one transform fits
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY): max_landmarks
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    pub fn merge(&mut self, other: &Map, options: Option<&MergeOptions>) -> Result<MergeReport> {
        let mut report = MergeReport::default();
        self.merge_into(other, options, &mut report)?;
        Ok(report)
    }

    /// [`MapCopy::merge`] that fills in `report` also if the merge is refused because of the contents of the maps:
    /// [`MergeReport::broken_id`] then names the landmark that failed a test.
    ///
    /// # Errors
    ///
    /// As [`MapCopy::merge`].
    pub fn merge_into(&mut self, other: &Map, options: Option<&MergeOptions>, report: &mut MergeReport) -> Result<()> {
        let options = options.map(MergeOptions::c_value);
        let options = options.as_ref().map_or(null(), |options| options as *const sys::cairn_merge_options);
        let mut written = MergeReport::empty_c();
        // SAFETY: two maps; the library reads the options and fills in the report.
        let result =
            call(|error| unsafe { sys::cairn_map_merge(self.0.as_ptr(), other.c(), options, &mut written, error) });
        *report = MergeReport::from_c(&written);
        result
    }

    /// Destroys the map, as the end of its life does.
    pub fn close(self) {}
}

impl Deref for MapCopy {
    type Target = Map;

    fn deref(&self) -> &Map {
        // SAFETY: the handle lives as long as `self`, and changes take &mut self.
        unsafe { Map::borrowed(self.0.as_ptr()) }
    }
}

impl Drop for MapCopy {
    //~ cairn_map_destroy
    fn drop(&mut self) {
        // SAFETY: the handle is used for the last time.
        unsafe { sys::cairn_map_destroy(self.0.as_ptr()) }
    }
}

impl fmt::Debug for Map {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Map").field("size", &self.size().ok()).finish()
    }
}

impl fmt::Debug for MapCopy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&**self, f)
    }
}
