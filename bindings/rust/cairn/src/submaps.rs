// SPDX-License-Identifier: BSD-3-Clause
//! Submaps, and the trajectory that moves with them.
use crate::arrays::{fill, gather, get};
use crate::error::{call, Result};
use crate::queries::{posed, report};
use crate::{ClosingReport, Covariance, Filter, Pose};
use cairn_sys as sys;
use std::ops::Range;
use std::ptr::null_mut;

/// A closed submap.
#[derive(Clone, Debug, PartialEq)]
pub struct Submap {
    /// The origin of the submap in the map.
    pub base: Pose,
    /// Its landmarks, in the order in which they were placed.
    pub ids: Vec<u64>,
}

impl Filter {
    //~ cairn_filter_close_submap
    /// Closes the open submap now. Allocates. A call that fails leaves the filter as it was, with the submap open.
    ///
    /// Complexity: dense O(n^2) for n states of the map; sparse: the part of the factor that the closing affects.
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_STATE`](crate::Status::ERROR_STATE): a single map, or the submap holds no landmark
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY): max_landmarks
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL)
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    pub fn close_submap(&mut self) -> Result<()> {
        // SAFETY: the handle only.
        self.change(|filter, error| unsafe { sys::cairn_filter_close_submap(filter, error) })
    }

    //~ cairn_filter_last_closing
    /// Reports on the last attempt to close a submap; zeros before the first attempt.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn last_closing(&self) -> Result<ClosingReport> {
        // SAFETY: the report states its size.
        report(ClosingReport::empty_c(), |report, error| unsafe {
            sys::cairn_filter_last_closing(self.c(), report, error)
        })
        .map(|report| ClosingReport::from_c(&report))
    }

    //~ cairn_filter_submap_count
    /// Number of submaps closed so far.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn submap_count(&self) -> Result<usize> {
        // SAFETY: a number is written.
        get(|count, error| unsafe { sys::cairn_filter_submap_count(self.c(), count, error) })
    }

    //~ cairn_filter_submap
    /// A closed submap, counted from 0: the pose of its origin in the map as known now (dense: as known at its
    /// closing), and the ids of its landmarks in the order in which they were placed. Of a submap that a sparse map has
    /// fused with others of its place they are the ids of this place.
    ///
    /// Complexity: O(landmarks of the submap).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn submap(&self, index: usize) -> Result<Submap> {
        let ids = gather(|ids| {
            // SAFETY: the library writes at most `capacity` ids.
            fill(ids, |first, capacity, needed, error| unsafe {
                sys::cairn_filter_submap(self.c(), index, null_mut(), first, capacity, needed, error)
            })
        })?;
        let mut needed = 0;
        // SAFETY: capacity 0 asks for the pose and the number of ids.
        let base = get(|base: *mut Pose, error| unsafe {
            sys::cairn_filter_submap(self.c(), index, base.cast(), null_mut(), 0, &mut needed, error)
        })?;
        Ok(Submap { base, ids })
    }

    //~ cairn_filter_local_pose
    /// Pose of the body in the open submap, and the covariance of its error \[dp; dtheta\] (6x6 row-major). With a
    /// single map: in the map.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn local_pose(&self) -> Result<(Pose, Covariance)> {
        // SAFETY: a pose and 36 values are written.
        posed(|pose, covariance, error| unsafe { sys::cairn_filter_local_pose(self.c(), pose, covariance, error) })
    }

    //~ cairn_filter_base_pose
    /// Pose of the open submap's origin in the map, and the covariance of its error \[dp; dtheta\] (6x6 row-major).
    /// That is what the closed submaps tell: landmarks that the open submap sees again, and fixes in it, correct
    /// [`Filter::pose`](crate::Filter::pose) at once and the origin at the closing. With a single map: identity and
    /// zero.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn base_pose(&self) -> Result<(Pose, Covariance)> {
        // SAFETY: as above.
        posed(|pose, covariance, error| unsafe { sys::cairn_filter_base_pose(self.c(), pose, covariance, error) })
    }

    //~ cairn_filter_keep_pose
    /// Keeps the pose of the body now, as an update does: for a step in which nothing was observed. `number` gets the
    /// number of the pose.
    ///
    /// Complexity: O(1); allocates nothing.
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_STATE`](crate::Status::ERROR_STATE): `trajectory_poses` is 0
    pub fn keep_pose(&mut self) -> Result<u64> {
        let mut number = 0;
        // SAFETY: a number is written.
        self.change(|filter, error| unsafe { sys::cairn_filter_keep_pose(filter, &mut number, error) })?;
        Ok(number)
    }

    //~ cairn_filter_trajectory_range
    /// The numbers of the poses that are kept: from `first` up to but not including `end`. `end` is the number of poses
    /// so far.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_STATE`](crate::Status::ERROR_STATE): `trajectory_poses` is 0
    pub fn trajectory_range(&self) -> Result<Range<u64>> {
        let (mut first, mut end) = (0, 0);
        // SAFETY: two numbers are written.
        call(|error| unsafe { sys::cairn_filter_trajectory_range(self.c(), &mut first, &mut end, error) })?;
        Ok(first..end)
    }

    //~ cairn_filter_trajectory
    /// The poses of the body in the map, as they are known now, from the number `first` to the newest one. Close the
    /// open submap first to have its last corrections.
    ///
    /// Complexity: O(poses); allocates nothing.
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_STATE`](crate::Status::ERROR_STATE): `trajectory_poses` is 0
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY): the trajectory has become longer than
    ///   `trajectory_poses`, and the pose `first` was dropped
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND): `first` is greater than the number of poses so
    ///   far
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn trajectory(&self, first: u64) -> Result<Vec<Pose>> {
        gather(|poses| self.trajectory_into(first, poses))
    }

    /// [`Filter::trajectory`] into memory of the caller.
    ///
    /// # Errors
    ///
    /// As [`Filter::trajectory`].
    pub fn trajectory_into(&self, first: u64, poses: &mut Vec<Pose>) -> Result<()> {
        // SAFETY: the library writes at most `capacity` poses, which have the layout of Pose.
        fill(poses, |start: *mut Pose, capacity, needed, error| unsafe {
            sys::cairn_filter_trajectory(self.c(), first, start.cast(), capacity, needed, error)
        })
    }
}
