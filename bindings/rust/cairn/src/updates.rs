// SPDX-License-Identifier: BSD-3-Clause
//! Observations, and changes of single landmarks.
use crate::arrays::{expect_length, first, pointer};
use crate::error::Result;
use crate::{Filter, Match, MatchResult, Observation, Reason, Sensor, ID_NONE};
use cairn_sys as sys;

impl Default for Match {
    /// A match that a call has not written yet: no landmark, no result.
    fn default() -> Self {
        Match { landmark: ID_NONE, result: MatchResult(0), reason: Reason::NONE, distance: 0.0, threshold: 0.0 }
    }
}

impl Observation {
    /// An observation with the noise of its sensor. A sensor of fewer values uses the first ones.
    pub fn new(id: u64, z: [f64; 3]) -> Observation {
        Observation { id, z, covariance: [0.0; 9] }
    }
}

impl Filter {
    //~ cairn_filter_update
    /// Updates the filter by one frame of one sensor. The observations of known landmarks update the state together. An
    /// observation with an unknown id places a new landmark, with all its correlations. `matches` (room for `count`)
    /// gets the match of each observation. `count` may be 0. Allocates nothing.
    ///
    /// Complexity: O(n^2 m) for n states and m rows.
    ///
    //~
    /// [`Filter::update_into`] writes the matches to memory of the caller and allocates nothing.
    //~ errors
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT): also an id twice, [`ID_NONE`](crate::ID_NONE),
    ///   noise that is not a covariance
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND): sensor
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY): more than max_observations
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL)
    /// - [`Status::ERROR_CALLBACK`](crate::Status::ERROR_CALLBACK): a custom sensor's function aborted
    pub fn update(&mut self, sensor: Sensor, observations: &[Observation]) -> Result<Vec<Match>> {
        let mut matches = vec![Match::default(); observations.len()];
        self.update_into(sensor, observations, &mut matches)?;
        Ok(matches)
    }

    /// [`Filter::update`] that writes the match of each observation to `matches`, which is as long as `observations`,
    /// or empty if the matches are not wanted.
    ///
    /// # Errors
    ///
    /// As [`Filter::update`].
    pub fn update_into(&mut self, sensor: Sensor, observations: &[Observation], matches: &mut [Match]) -> Result<()> {
        let wanted = if matches.is_empty() {
            std::ptr::null_mut()
        } else {
            expect_length("matches", matches.len(), observations.len())?;
            matches.as_mut_ptr()
        };
        let (start, count) = (first(observations).cast(), observations.len());
        // SAFETY: arrays of `count` elements with the layout of C.
        self.change(|filter, error| unsafe {
            sys::cairn_filter_update(filter, sensor.0, start, count, wanted.cast(), error)
        })
    }

    //~ cairn_filter_update_linear
    /// Updates the filter by an observation that the caller has linearised: `residual = z - h` (rows values),
    /// `covariance` of the noise (rows x rows), `jacobian_pose` = dh/\[dp; dtheta\] (rows x 6, `None` for zero) and
    /// `jacobian_landmarks` = dh/d positions (rows x 3 count, columns in the order of `landmarks`); all row-major. With
    /// submaps, pose and landmarks are those of the open submap, in its frame. The observation is gated as one of that
    /// many rows (gate_probability) and is not iterated. `match` gets the match; its landmark is the first one, or
    /// [`ID_NONE`](crate::ID_NONE). rows is 1 to 3 max_observations (planar: 2), count at most max_observations.
    ///
    /// Complexity: O(n^2 rows).
    ///
    //~
    /// In Rust the number of rows is that of `residual`.
    //~ errors
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND)
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY)
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL)
    pub fn update_linear(
        &mut self,
        residual: &[f64],
        covariance: &[f64],
        jacobian_pose: Option<&[f64]>,
        landmarks: &[u64],
        jacobian_landmarks: &[f64],
    ) -> Result<Match> {
        let (rows, count) = (residual.len(), landmarks.len());
        expect_length("covariance", covariance.len(), rows * rows)?;
        if let Some(jacobian) = jacobian_pose {
            expect_length("jacobian_pose", jacobian.len(), rows * 6)?;
        }
        expect_length("jacobian_landmarks", jacobian_landmarks.len(), rows * 3 * count)?;
        let (landmarks, jacobian_landmarks) = (first(landmarks), first(jacobian_landmarks));
        let jacobian_pose = first(jacobian_pose.unwrap_or_default());
        // SAFETY: the lengths are those that the library reads.
        self.matched(|filter, found, error| unsafe {
            let (residual, covariance) = (first(residual), first(covariance));
            sys::cairn_filter_update_linear(
                filter,
                residual,
                rows,
                covariance,
                jacobian_pose,
                landmarks,
                count,
                jacobian_landmarks,
                found,
                error,
            )
        })
    }

    //~ cairn_filter_update_position
    /// Updates the filter by an absolute position (GNSS): `z = p + R lever_arm` in the map frame, m; 3x3 `covariance`,
    /// positive definite. `lever_arm` (body frame, m) may be `None`: zero. `match` gets the match.
    ///
    /// Complexity: O(n^2).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL)
    pub fn update_position(
        &mut self,
        position: &[f64; 3],
        covariance: &[f64; 9],
        lever_arm: Option<&[f64; 3]>,
    ) -> Result<Match> {
        // SAFETY: arrays of fixed lengths.
        self.matched(|filter, found, error| unsafe {
            let (position, covariance, lever_arm) = (position.as_ptr(), covariance.as_ptr(), pointer(lever_arm));
            sys::cairn_filter_update_position(filter, position, covariance, lever_arm, found, error)
        })
    }

    //~ cairn_filter_update_attitude
    /// Updates the filter by an absolute attitude (star tracker): quaternion w x y z from body to map; 3x3 `covariance`
    /// (rad^2, positive definite) of its error dtheta in the map's axes. `match` gets the match.
    ///
    /// Complexity: O(n^2).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL)
    pub fn update_attitude(&mut self, quaternion: &[f64; 4], covariance: &[f64; 9]) -> Result<Match> {
        // SAFETY: arrays of fixed lengths.
        self.matched(|filter, found, error| unsafe {
            sys::cairn_filter_update_attitude(filter, quaternion.as_ptr(), covariance.as_ptr(), found, error)
        })
    }

    //~ cairn_filter_update_heading
    /// Updates the filter by an absolute heading (sun sensor, compass): the yaw of the body's x axis in the map, rad,
    /// with its standard deviation (> 0). A tilted body adds noise of second order (docs/sensors.md). The heading is
    /// refused ([`Reason::NO_IMAGE`](crate::Reason::NO_IMAGE)) if the x axis is within three standard deviations of the
    /// tilt of the vertical. `match` gets the match.
    ///
    /// Complexity: O(n^2).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL)
    pub fn update_heading(&mut self, heading: f64, sigma: f64) -> Result<Match> {
        // SAFETY: numbers only.
        self.matched(|filter, found, error| unsafe {
            sys::cairn_filter_update_heading(filter, heading, sigma, found, error)
        })
    }

    //~ cairn_filter_remove_landmark
    /// Removes a landmark from the map and from the open submap. The information that it gave about other states stays.
    ///
    /// Complexity: O(n).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND)
    pub fn remove_landmark(&mut self, id: u64) -> Result<()> {
        // SAFETY: numbers only.
        self.change(|filter, error| unsafe { sys::cairn_filter_remove_landmark(filter, id, error) })
    }

    //~ cairn_filter_merge_landmarks
    /// Merges two landmarks of the open submap, or of the single map, that are in truth one. The filter observes that
    /// their difference is zero; this observation is gated like any other (gate_probability). If it passes, `other` is
    /// removed, and `id` stays with the observations of both. `match` gets the match.
    ///
    /// Complexity: O(n^2).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND)
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY): max_observations is 1
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL)
    pub fn merge_landmarks(&mut self, id: u64, other: u64) -> Result<Match> {
        // SAFETY: numbers only.
        self.matched(|filter, found, error| unsafe {
            sys::cairn_filter_merge_landmarks(filter, id, other, found, error)
        })
    }

    //~ cairn_filter_split_landmark
    /// Splits a landmark that is in truth two landmarks. The new landmark `fresh` gets the position of `id` plus an
    /// independent error with this 3x3 covariance (positive definite; it says how far apart the two may be). Later
    /// observations separate the two.
    ///
    /// Complexity: O(n).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT): also if `fresh` exists, or if the filter names
    ///   landmarks itself and `fresh` is 2^63 or more
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND)
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY)
    pub fn split_landmark(&mut self, id: u64, fresh: u64, covariance: &[f64; 9]) -> Result<()> {
        // SAFETY: an array of nine values.
        self.change(|filter, error| unsafe {
            sys::cairn_filter_split_landmark(filter, id, fresh, covariance.as_ptr(), error)
        })
    }

    fn matched(
        &mut self,
        update: impl FnOnce(*mut sys::cairn_filter, *mut sys::cairn_match, *mut sys::cairn_error) -> sys::cairn_status,
    ) -> Result<Match> {
        let mut found = Match::default();
        self.change(|filter, error| update(filter, (&mut found as *mut Match).cast(), error))?;
        Ok(found)
    }
}
