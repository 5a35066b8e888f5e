// SPDX-License-Identifier: BSD-3-Clause
//! What a filter knows: pose, maps, reports, health, systematic errors.
use crate::arrays::{fill, first, gather, get};
use crate::error::{call, Result};
use crate::{Covariance, Filter, Health, Map, Pose, Sensor, SensorHealth, SystematicError, UpdateReport};
use cairn_sys as sys;
use std::ptr::null_mut;

/// A pose and the covariance of its error.
#[inline]
pub(crate) fn posed(
    query: impl FnOnce(*mut sys::cairn_pose, *mut f64, *mut sys::cairn_error) -> sys::cairn_status,
) -> Result<(Pose, Covariance)> {
    let mut covariance = [0.0; 36];
    let pose = get(|pose: *mut Pose, error| query(pose.cast(), covariance.as_mut_ptr(), error))?;
    Ok((pose, covariance))
}

/// A struct that states its size before the library fills it in.
#[inline]
pub(crate) fn report<T>(
    mut empty: T,
    query: impl FnOnce(*mut T, *mut sys::cairn_error) -> sys::cairn_status,
) -> Result<T> {
    call(|error| query(&mut empty, error))?;
    Ok(empty)
}

impl Filter {
    //~ cairn_filter_pose
    /// Pose of the body in the map, and the covariance of its error \[dp; dtheta\] (6x6 row-major). With submaps the
    /// pose knows what the open submap has seen again of the map, before the submap is closed.
    ///
    /// Complexity: O(1); with submaps O(d^3) for d landmarks that the open submap and the map have in common, and once
    /// after d has changed what [`Map::joint_covariance`](crate::Map::joint_covariance) of them costs.
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn pose(&self) -> Result<(Pose, Covariance)> {
        // SAFETY: a pose and 36 values are written.
        posed(|pose, covariance, error| unsafe { sys::cairn_filter_pose(self.c(), pose, covariance, error) })
    }

    //~ cairn_filter_map
    /// The filter's map. With submaps it holds the landmarks of the closed submaps; the landmarks of the open submap
    /// join it when this submap is closed. The filter owns this map; it lives as long as the filter and follows it.
    ///
    /// Complexity: O(1).
    pub fn map(&self) -> &Map {
        // SAFETY: the map lives as long as the filter, and no call changes the filter while the map is borrowed.
        unsafe { Map::borrowed(sys::cairn_filter_map(self.c())) }
    }

    //~ cairn_filter_local_map
    /// The landmarks of the open submap, in its frame; with a single map the same as
    /// [`Filter::map`](crate::Filter::map). The filter owns this map; it lives as long as the filter and follows it.
    ///
    /// Complexity: O(1).
    pub fn local_map(&self) -> &Map {
        // SAFETY: as above.
        unsafe { Map::borrowed(sys::cairn_filter_local_map(self.c())) }
    }

    //~ cairn_filter_joint_covariance
    /// Joint covariance of the pose's error \[dp; dtheta\] and the positions of chosen landmarks, in this order,
    /// row-major, with 6 + 3 count rows and columns.
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

    /// [`Filter::joint_covariance`] into memory of the caller.
    ///
    /// # Errors
    ///
    /// As [`Filter::joint_covariance`].
    pub fn joint_covariance_into(&self, ids: &[u64], matrix: &mut Vec<f64>) -> Result<()> {
        // SAFETY: the library writes at most `capacity` values.
        fill(matrix, |start, capacity, needed, error| unsafe {
            sys::cairn_filter_joint_covariance(self.c(), first(ids), ids.len(), start, capacity, needed, error)
        })
    }

    //~ cairn_filter_pose_nees
    /// Normalised estimation error squared (NEES) of the pose against the true pose, in the error coordinates of the
    /// filter. A consistent filter has 6 on average, for a planar vehicle 3.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL): the covariance of the pose is singular, as at a
    ///   known start
    pub fn pose_nees(&self, truth: &Pose) -> Result<f64> {
        // SAFETY: a number is written.
        get(|nees, error| unsafe { sys::cairn_filter_pose_nees(self.c(), truth.c(), nees, error) })
    }

    //~ cairn_filter_audit
    /// Checks the whole covariance (with submaps, that of the open submap): `min_pivot` gets the smallest pivot of its
    /// Cholesky factor after scaling to unit diagonal. It is 0 or less if the covariance is not positive definite.
    /// States that are known exactly (zero variance) are left out.
    ///
    /// Complexity: O(n^3).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn audit(&mut self) -> Result<f64> {
        let mut min_pivot = 0.0;
        // SAFETY: a number is written.
        self.change(|filter, error| unsafe { sys::cairn_filter_audit(filter, &mut min_pivot, error) })?;
        Ok(min_pivot)
    }

    //~ cairn_filter_last_update
    /// Reports on the last successful update of any kind; zeros before the first update.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn last_update(&self) -> Result<UpdateReport> {
        // SAFETY: the report states its size.
        report(UpdateReport::empty_c(), |report, error| unsafe {
            sys::cairn_filter_last_update(self.c(), report, error)
        })
        .map(|report| UpdateReport::from_c(&report))
    }

    //~ cairn_filter_health
    /// The verdict on a filter. All of it is what the last update left: the call computes nothing.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn health(&self) -> Result<Health> {
        // SAFETY: the report states its size.
        report(Health::empty_c(), |health, error| unsafe { sys::cairn_filter_health(self.c(), health, error) })
            .map(|health| Health::from_c(&health))
    }

    //~ cairn_filter_sensor_health
    /// What the observations of one sensor show.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND): sensor
    pub fn sensor_health(&self, sensor: Sensor) -> Result<SensorHealth> {
        // SAFETY: the report states its size.
        report(SensorHealth::empty_c(), |health, error| unsafe {
            sys::cairn_filter_sensor_health(self.c(), sensor.0, health, error)
        })
        .map(|health| SensorHealth::from_c(&health))
    }

    //~ cairn_filter_systematic_errors
    /// The estimates of all components that are states, those of the motion first, then sensor by sensor in the order
    /// of their calibration, each in the order of kinds and components. `needed` is their number.
    ///
    /// Complexity: O(1).
    ///
    //~
    /// In Rust the estimates and their covariance are the two results.
    //~ errors
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn systematic_errors(&self) -> Result<(Vec<SystematicError>, Vec<f64>)> {
        let mut count = 0;
        // SAFETY: capacity 0 asks for the number.
        call(|error| unsafe {
            sys::cairn_filter_systematic_errors(self.c(), null_mut(), null_mut(), 0, &mut count, error)
        })?;
        let mut errors = Vec::with_capacity(count);
        let mut covariance = vec![0.0; count * count];
        if count > 0 {
            let (first, matrix) = (errors.as_mut_ptr(), covariance.as_mut_ptr());
            // SAFETY: room for `count` estimates and the square of that number.
            call(|error| unsafe {
                sys::cairn_filter_systematic_errors(self.c(), first, matrix, count, &mut count.clone(), error)
            })?;
            // SAFETY: the library has written them.
            unsafe { errors.set_len(count) };
        }
        Ok((errors.iter().map(SystematicError::from_c).collect(), covariance))
    }
}
