// SPDX-License-Identifier: BSD-3-Clause
//! Functions of the caller that the library calls. An error or a panic in such a function never crosses C: it is kept
//! for this thread, the call is aborted, and the error or the panic continues when the call has returned.
#![allow(clippy::declare_interior_mutable_const)] // what clippy 1.63 says of every thread_local with a const value
use crate::error::Source;
use crate::Pose;
use cairn_sys as sys;
use std::any::Any;
use std::cell::RefCell;
use std::ffi::CStr;
use std::os::raw::{c_char, c_void};
use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};
use std::slice;

/// Answer of a function of a custom sensor: `Ok(true)` if it has written all its outputs, `Ok(false)` if there is no
/// answer (the landmark cannot be seen, or the observation cannot place a landmark). An error aborts the whole call.
pub type Answer = std::result::Result<bool, Source>;

/// Outputs of a custom sensor's prediction. Each value is NaN beforehand and must be written, zeros too.
pub struct Prediction<'a> {
    /// The predicted observation, one value a row.
    pub z: &'a mut [f64],
    /// dz / [dp; dtheta], one row a value.
    pub jacobian_pose: &'a mut [[f64; 6]],
    /// dz / dlandmark, one row a value.
    pub jacobian_landmark: &'a mut [[f64; 3]],
}

/// Outputs of a custom sensor's placing. Each value is NaN beforehand and must be written, zeros too.
pub struct Placement<'a> {
    /// The landmark in the map, m.
    pub landmark: &'a mut [f64; 3],
    /// dlandmark / [dp; dtheta].
    pub jacobian_pose: &'a mut [[f64; 6]; 3],
    /// dlandmark / dz, row-major: 3 rows, as many columns as the observation has values.
    pub jacobian_z: &'a mut [f64],
}

enum Failure {
    Error(Source),
    Panic(Box<dyn Any + Send>),
}

thread_local! {
    static FAILURE: RefCell<Option<Failure>> = const { RefCell::new(None) };
}

fn keep(failure: Failure) {
    let mut failure = Some(failure);
    let _ = FAILURE.try_with(|slot| {
        let mut slot = slot.borrow_mut();
        if slot.is_none() {
            *slot = failure.take();
        }
    });
    // The first failure is the one that is told. A second one is forgotten, not dropped: its drop could panic.
    std::mem::forget(failure);
}

/// Runs a function of the caller and turns what it does into the answer that C expects.
fn guarded(function: impl FnOnce() -> Answer) -> i32 {
    match catch_unwind(AssertUnwindSafe(function)) {
        Ok(Ok(answer)) => i32::from(answer),
        Ok(Err(error)) => {
            keep(Failure::Error(error));
            -1
        }
        Err(panic) => {
            keep(Failure::Panic(panic));
            -1
        }
    }
}

/// The error by which a callback aborted the last call of this thread. If it was a panic, the panic continues.
pub(crate) fn take_failure() -> Option<Source> {
    match FAILURE.try_with(|slot| slot.borrow_mut().take()).ok().flatten()? {
        Failure::Error(source) => Some(source),
        Failure::Panic(panic) => resume_unwind(panic),
    }
}

/// Continues the panic of a callback that cannot abort its call: a log, or the drop of what a callback owned.
pub(crate) fn resume() {
    if !std::thread::panicking() {
        take_failure();
    }
}

/// Receives the lines of a filter's log.
pub(crate) unsafe extern "C" fn log<F: FnMut(&str)>(payload: *mut c_void, line: *const c_char) {
    // SAFETY: `payload` is the box of `F` that was given with this function; `line` is a text of the library.
    let (function, line) = unsafe { (&mut *payload.cast::<F>(), CStr::from_ptr(line)) };
    guarded(|| {
        function(&line.to_string_lossy());
        Ok(true)
    });
}

/// Drops the box of a `T` that the library does not use any more.
pub(crate) unsafe extern "C" fn release<T>(payload: *mut c_void) {
    guarded(|| {
        // SAFETY: `payload` came from Box::into_raw of a Box<T>, and the library gives it back once.
        drop(unsafe { Box::from_raw(payload.cast::<T>()) });
        Ok(true)
    });
}

/// Both functions of a custom sensor, and the number of its values. The library gives pointers without lengths.
pub(crate) struct Model<P, Q> {
    pub rows: usize,
    pub predict: P,
    pub place: Q,
}

pub(crate) unsafe extern "C" fn predict<P, Q>(
    user: *mut c_void,
    pose: *const sys::cairn_pose,
    landmark: *const f64,
    z: *mut f64,
    jacobian_pose: *mut f64,
    jacobian_landmark: *mut f64,
) -> i32
where
    P: FnMut(&Pose, &[f64; 3], Prediction<'_>) -> Answer,
{
    // SAFETY: `user` is the Model<P, Q> that was given with this function, and nothing else uses it during the call.
    // The library gives arrays of the sizes that its header states; Pose has the layout of cairn_pose.
    let (model, pose, landmark) =
        unsafe { (&mut *user.cast::<Model<P, Q>>(), &*pose.cast::<Pose>(), &*landmark.cast::<[f64; 3]>()) };
    // SAFETY: as above.
    let out = unsafe {
        Prediction {
            z: slice::from_raw_parts_mut(z, model.rows),
            jacobian_pose: slice::from_raw_parts_mut(jacobian_pose.cast(), model.rows),
            jacobian_landmark: slice::from_raw_parts_mut(jacobian_landmark.cast(), model.rows),
        }
    };
    let function = &mut model.predict;
    guarded(|| function(pose, landmark, out))
}

pub(crate) unsafe extern "C" fn place<P, Q>(
    user: *mut c_void,
    pose: *const sys::cairn_pose,
    z: *const f64,
    landmark: *mut f64,
    jacobian_pose: *mut f64,
    jacobian_z: *mut f64,
) -> i32
where
    Q: FnMut(&Pose, &[f64], Placement<'_>) -> Answer,
{
    // SAFETY: as in `predict`.
    let (model, pose) = unsafe { (&mut *user.cast::<Model<P, Q>>(), &*pose.cast::<Pose>()) };
    // SAFETY: as in `predict`.
    let (z, out) = unsafe {
        let out = Placement {
            landmark: &mut *landmark.cast(),
            jacobian_pose: &mut *jacobian_pose.cast(),
            jacobian_z: slice::from_raw_parts_mut(jacobian_z, 3 * model.rows),
        };
        (slice::from_raw_parts(z, model.rows), out)
    };
    let function = &mut model.place;
    guarded(|| function(pose, z, out))
}
