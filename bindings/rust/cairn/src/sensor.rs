// SPDX-License-Identifier: BSD-3-Clause
//! Sensors: those that the library models, and those that the caller models.
use crate::arrays::get;
use crate::callback::{self, Answer, Model, Placement, Prediction};
use crate::error::Result;
use crate::{Calibration, Cartesian, Custom, Filter, Loss, Pose, RangeBearing, StereoCamera, StereoHead};
use cairn_sys as sys;
use std::os::raw::c_void;

/// A sensor of a filter: the number that the filter gave it when it was added, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Sensor(
    /// The number.
    pub i32,
);

impl Filter {
    //~ cairn_filter_add_stereo_head
    /// Adds a stereo head.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY)
    pub fn add_stereo_head(&mut self, head: &StereoHead) -> Result<Sensor> {
        // SAFETY: the library copies the description.
        self.add(|filter, sensor, error| unsafe {
            sys::cairn_filter_add_stereo_head(filter, &head.c_value(), sensor, error)
        })
    }

    //~ cairn_filter_add_stereo_camera
    /// Adds a stereo camera.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY)
    pub fn add_stereo_camera(&mut self, camera: &StereoCamera) -> Result<Sensor> {
        // SAFETY: as above.
        self.add(|filter, sensor, error| unsafe {
            sys::cairn_filter_add_stereo_camera(filter, &camera.c_value(), sensor, error)
        })
    }

    //~ cairn_filter_add_range_bearing
    /// Adds a planar range-bearing sensor (radar, lidar, sonar).
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT): also if the vehicle is spatial
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY)
    pub fn add_range_bearing(&mut self, radar: &RangeBearing) -> Result<Sensor> {
        // SAFETY: as above.
        self.add(|filter, sensor, error| unsafe {
            sys::cairn_filter_add_range_bearing(filter, &radar.c_value(), sensor, error)
        })
    }

    //~ cairn_filter_add_cartesian
    /// Adds a cartesian sensor, which gives points.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY)
    pub fn add_cartesian(&mut self, cartesian: &Cartesian) -> Result<Sensor> {
        // SAFETY: as above.
        self.add(|filter, sensor, error| unsafe {
            sys::cairn_filter_add_cartesian(filter, &cartesian.c_value(), sensor, error)
        })
    }

    //~ cairn_filter_add_custom
    /// Adds a sensor of the caller's own. `predict` is required.
    ///
    /// Complexity: O(1).
    ///
    //~
    /// In Rust the functions are closures, which run inside [`Filter::update`]. A sensor of fewer than 3 values
    /// (planar: 2) cannot place a landmark: add it by [`Filter::add_custom_observer`]. [`Custom::check`] tests the Jacobians.
    //~ errors
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY)
    pub fn add_custom<P, Q>(&mut self, custom: &Custom, predict: P, place: Q) -> Result<Sensor>
    where
        P: FnMut(&Pose, &[f64; 3], Prediction<'_>) -> Answer + Send + 'static,
        Q: FnMut(&Pose, &[f64], Placement<'_>) -> Answer + Send + 'static,
    {
        let model = Model { rows: custom.rows as usize, predict, place };
        self.add_model(custom, Some(callback::predict::<P, Q>), Some(callback::place::<P, Q>), model)
    }

    /// Adds a sensor of the caller's own that places no landmarks: [`Filter::add_custom`] without `place`.
    ///
    /// # Errors
    ///
    /// As [`Filter::add_custom`].
    pub fn add_custom_observer<P>(&mut self, custom: &Custom, predict: P) -> Result<Sensor>
    where
        P: FnMut(&Pose, &[f64; 3], Prediction<'_>) -> Answer + Send + 'static,
    {
        let model = Model { rows: custom.rows as usize, predict, place: () };
        self.add_model(custom, Some(callback::predict::<P, ()>), None, model)
    }

    fn add_model<M: 'static>(
        &mut self,
        custom: &Custom,
        predict: sys::cairn_custom_predict_fn,
        place: sys::cairn_custom_place_fn,
        model: M,
    ) -> Result<Sensor> {
        let user: *mut c_void = Box::into_raw(Box::new(model)).cast();
        // SAFETY: the functions belong to the type of the model, which lives until the library releases it.
        let result = self.add(|filter, sensor, error| unsafe {
            let release = Some(callback::release::<M> as _);
            sys::cairn_filter_add_custom(filter, &custom.c_value(), predict, place, user, release, sensor, error)
        });
        if result.is_err() {
            // SAFETY: a call that fails leaves the model to its caller.
            drop(unsafe { Box::from_raw(user.cast::<M>()) });
        }
        result
    }

    fn add(
        &mut self,
        add: impl FnOnce(*mut sys::cairn_filter, *mut i32, *mut sys::cairn_error) -> sys::cairn_status,
    ) -> Result<Sensor> {
        let mut sensor = -1;
        self.change(|filter, error| add(filter, &mut sensor, error))?;
        Ok(Sensor(sensor))
    }

    //~ cairn_filter_point_head
    /// Sets the pan and stick angle (rad) of a stereo head from now on; both are 0 after it was added. Call this
    /// function before each frame that was taken at other angles.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT): not finite, or no stereo head
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND)
    pub fn point_head(&mut self, sensor: Sensor, pan: f64, stick: f64) -> Result<()> {
        // SAFETY: numbers only.
        self.change(|filter, error| unsafe { sys::cairn_filter_point_head(filter, sensor.0, pan, stick, error) })
    }

    //~ cairn_filter_set_loss
    /// Sets the loss of a sensor's residuals: an observation whose distance is large gets less weight, instead of being
    /// refused. `width` (> 0) is where the loss leaves the parabola, in standard deviations of the observation's noise.
    /// The weights are found in the iteration of the update, and the covariance is that of the robust estimate
    /// (docs/update.md, "Robust losses"). The chi-square gates stay; options with gate probabilities of 1 open them.
    /// [`Loss::NONE`](crate::Loss::NONE) takes the loss away; `width` is then ignored. Allocates nothing.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND)
    pub fn set_loss(&mut self, sensor: Sensor, loss: Loss, width: f64) -> Result<()> {
        // SAFETY: numbers only.
        self.change(|filter, error| unsafe { sys::cairn_filter_set_loss(filter, sensor.0, loss.0, width, error) })
    }

    //~ cairn_filter_set_view
    /// Sets the region in which a sensor detects every landmark: all observations between `lower` and `upper`, value by
    /// value, in the sensor's units. An infinite value is no bound. A sensor of fewer than 3 rows uses the first
    /// values. A frame has missed a landmark if its predicted observation lies inside the region by three standard
    /// deviations, and no observation of the frame was compared with the landmark (`missed_frames`).
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND)
    pub fn set_view(&mut self, sensor: Sensor, lower: &[f64; 3], upper: &[f64; 3]) -> Result<()> {
        // SAFETY: arrays of three values.
        self.change(|filter, error| unsafe {
            sys::cairn_filter_set_view(filter, sensor.0, lower.as_ptr(), upper.as_ptr(), error)
        })
    }

    //~ cairn_filter_calibrate_sensor
    /// Makes systematic errors of a sensor states of the filter. Call it after the sensor was added, before the first
    /// motion and the first observation, at most once for a sensor. All sensors together have at most max_sensor_errors
    /// of [`FilterOptions`](crate::FilterOptions). Association (with unknown ids) uses the estimates, but leaves their
    /// uncertainty out of its gates.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND): sensor
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY)
    /// - [`Status::ERROR_STATE`](crate::Status::ERROR_STATE): too late, or calibrated already
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    pub fn calibrate_sensor(&mut self, sensor: Sensor, calibration: &Calibration) -> Result<()> {
        // SAFETY: the library copies the description.
        self.change(|filter, error| unsafe {
            sys::cairn_filter_calibrate_sensor(filter, sensor.0, &calibration.c_value(), error)
        })
    }
}

impl Custom {
    //~ cairn_custom_check
    /// Compares a custom sensor's Jacobians with central differences on the manifold, at one pose and landmark. `worst`
    /// gets the largest difference; each difference is relative to max(1, |numerical value|). A correct Jacobian gives
    /// about 1e-6 or less. If `place` is given, it is checked at the observation that `predict` gives: its Jacobians,
    /// and that it returns to the landmark. `relative` is not checked.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT): also if `predict` refuses the landmark
    /// - [`Status::ERROR_CALLBACK`](crate::Status::ERROR_CALLBACK)
    pub fn check<P, Q>(&self, predict: P, place: Q, pose: &Pose, landmark: &[f64; 3]) -> Result<f64>
    where
        P: FnMut(&Pose, &[f64; 3], Prediction<'_>) -> Answer,
        Q: FnMut(&Pose, &[f64], Placement<'_>) -> Answer,
    {
        let mut model = Model { rows: self.rows as usize, predict, place };
        let user = (&mut model as *mut Model<P, Q>).cast();
        let (predict, place) = (callback::predict::<P, Q>, callback::place::<P, Q>);
        self.check_functions(Some(predict), Some(place), user, pose, landmark)
    }

    /// Compares the Jacobians of a sensor that places no landmarks: [`Custom::check`] without `place`.
    ///
    /// # Errors
    ///
    /// As [`Custom::check`].
    pub fn check_observer<P>(&self, predict: P, pose: &Pose, landmark: &[f64; 3]) -> Result<f64>
    where
        P: FnMut(&Pose, &[f64; 3], Prediction<'_>) -> Answer,
    {
        let mut model = Model { rows: self.rows as usize, predict, place: () };
        let user = (&mut model as *mut Model<P, ()>).cast();
        self.check_functions(Some(callback::predict::<P, ()>), None, user, pose, landmark)
    }

    fn check_functions(
        &self,
        predict: sys::cairn_custom_predict_fn,
        place: sys::cairn_custom_place_fn,
        user: *mut c_void,
        pose: &Pose,
        landmark: &[f64; 3],
    ) -> Result<f64> {
        // SAFETY: the model outlives the call, and the functions belong to its type.
        get(|worst, error| unsafe {
            sys::cairn_custom_check(&self.c_value(), predict, place, user, pose.c(), landmark.as_ptr(), worst, error)
        })
    }
}
