// SPDX-License-Identifier: BSD-3-Clause
//! Motions of the vehicle.
use crate::error::Result;
use crate::{Covariance, Filter, Pose, TwistNoise, Wheels};
use cairn_sys as sys;

impl Filter {
    //~ cairn_filter_set_wheels
    /// Sets the wheels for [`Filter::predict_wheels`](crate::Filter::predict_wheels). Until then those of
    /// [`Wheels::default`](crate::Wheels::default) are used.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn set_wheels(&mut self, wheels: &Wheels) -> Result<()> {
        // SAFETY: the library copies the description.
        self.change(|filter, error| unsafe { sys::cairn_filter_set_wheels(filter, &wheels.c_value(), error) })
    }

    //~ cairn_filter_set_twist_noise
    /// Sets the noise of [`Filter::predict_twist`](crate::Filter::predict_twist). Until then that of
    /// [`TwistNoise::default`](crate::TwistNoise::default) is used.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn set_twist_noise(&mut self, noise: &TwistNoise) -> Result<()> {
        // SAFETY: the library copies the description.
        self.change(|filter, error| unsafe { sys::cairn_filter_set_twist_noise(filter, &noise.c_value(), error) })
    }

    //~ cairn_filter_predict_wheels
    /// Moves the vehicle by the turning rates of its left and right wheels (rad/s) over `dt` seconds (> 0). Mars paper,
    /// eq. 1 and 2.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL)
    pub fn predict_wheels(&mut self, dt: f64, left_rad_per_s: f64, right_rad_per_s: f64) -> Result<()> {
        // SAFETY: numbers only.
        self.change(|filter, error| unsafe {
            sys::cairn_filter_predict_wheels(filter, dt, left_rad_per_s, right_rad_per_s, error)
        })
    }

    //~ cairn_filter_predict_wheels_gyro
    /// Moves the vehicle by the turning rates of its left and right wheels (rad/s) and the body rate of a gyro (rad/s)
    /// over `dt` seconds (> 0): the velocity is that of [`Filter::predict_wheels`](crate::Filter::predict_wheels), with
    /// its noise, and the rate has the noise of [`Filter::set_twist_noise`](crate::Filter::set_twist_noise). A planar
    /// vehicle reads only the rate about z.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL)
    pub fn predict_wheels_gyro(
        &mut self,
        dt: f64,
        left_rad_per_s: f64,
        right_rad_per_s: f64,
        rate: &[f64; 3],
    ) -> Result<()> {
        // SAFETY: an array of three values.
        self.change(|filter, error| unsafe {
            sys::cairn_filter_predict_wheels_gyro(filter, dt, left_rad_per_s, right_rad_per_s, rate.as_ptr(), error)
        })
    }

    //~ cairn_filter_predict_twist
    /// Moves the vehicle by its body velocity (m/s) and body rate (rad/s) over `dt` seconds (> 0). Mars paper, eq. 2.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL)
    pub fn predict_twist(&mut self, dt: f64, velocity: &[f64; 3], rate: &[f64; 3]) -> Result<()> {
        // SAFETY: arrays of three values.
        self.change(|filter, error| unsafe {
            sys::cairn_filter_predict_twist(filter, dt, velocity.as_ptr(), rate.as_ptr(), error)
        })
    }

    //~ cairn_filter_predict_increment
    /// Moves the vehicle by a relative pose, `T_map_body <- T_map_body T_before_after`, with the covariance (6x6
    /// row-major, symmetric, positive semidefinite) of its error \[dp; dtheta\] in the axes of the body before the
    /// motion. An increment has no duration: a filter that estimates a velocity or rate bias refuses it, and no random
    /// walk goes on.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL)
    /// - [`Status::ERROR_STATE`](crate::Status::ERROR_STATE): a bias is a state
    pub fn predict_increment(&mut self, t_before_after: &Pose, covariance: &Covariance) -> Result<()> {
        // SAFETY: a pose, and an array of 36 values.
        self.change(|filter, error| unsafe {
            sys::cairn_filter_predict_increment(filter, t_before_after.c(), covariance.as_ptr(), error)
        })
    }
}
