// SPDX-License-Identifier: BSD-3-Clause
//! Poses and quaternions.
use crate::arrays::get;
use crate::error::{call, Result};
use crate::Pose;
use cairn_sys as sys;

impl Pose {
    pub(crate) fn c(&self) -> *const sys::cairn_pose {
        (self as *const Pose).cast()
    }

    //~ cairn_pose_identity
    /// Sets a pose to the identity.
    ///
    /// Complexity: O(1).
    pub fn identity() -> Pose {
        let mut pose = Pose { position: [0.0; 3], quaternion: [1.0, 0.0, 0.0, 0.0] };
        // SAFETY: Pose has the layout of cairn_pose. The call fails only for NULL.
        let _ = call(|error| unsafe { sys::cairn_pose_identity((&mut pose as *mut Pose).cast(), error) });
        pose
    }

    //~ cairn_pose_compose
    /// Composes two poses: `T_a_c = T_a_b * T_b_c`. Quaternions are normalised; a quaternion that is zero or not finite
    /// is refused. `result` may be one of the inputs.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn compose(&self, other: &Pose) -> Result<Pose> {
        // SAFETY: Pose has the layout of cairn_pose.
        get(|pose: *mut Pose, error| unsafe { sys::cairn_pose_compose(self.c(), other.c(), pose.cast(), error) })
    }

    //~ cairn_pose_inverse
    /// Inverts a pose: `T_b_a` from `T_a_b`.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn inverse(&self) -> Result<Pose> {
        // SAFETY: as above.
        get(|pose: *mut Pose, error| unsafe { sys::cairn_pose_inverse(self.c(), pose.cast(), error) })
    }

    //~ cairn_pose_apply
    /// Transforms a point from frame b to frame a (m).
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn apply(&self, point_b: &[f64; 3]) -> Result<[f64; 3]> {
        // SAFETY: arrays of three values.
        get(|point: *mut [f64; 3], error| unsafe {
            sys::cairn_pose_apply(self.c(), point_b.as_ptr(), point.cast(), error)
        })
    }

    //~ cairn_pose_error
    /// Error of an estimate against the truth: `difference` gets `[dp; dtheta]` as [`Pose`](crate::Pose) defines it.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn error(truth: &Pose, estimate: &Pose) -> Result<[f64; 6]> {
        // SAFETY: an array of six values.
        get(|difference: *mut [f64; 6], error| unsafe {
            sys::cairn_pose_error(truth.c(), estimate.c(), difference.cast(), error)
        })
    }
}

impl Default for Pose {
    fn default() -> Self {
        Pose::identity()
    }
}

//~ cairn_quaternion_from_euler
/// Quaternion of roll, pitch and yaw (rad): `R = Rz(yaw) Ry(pitch) Rx(roll)`.
///
/// Complexity: O(1).
///
/// # Errors
///
/// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT): not finite
pub fn quaternion_from_euler(roll: f64, pitch: f64, yaw: f64) -> Result<[f64; 4]> {
    // SAFETY: an array of four values.
    get(|quaternion: *mut [f64; 4], error| unsafe {
        sys::cairn_quaternion_from_euler(roll, pitch, yaw, quaternion.cast(), error)
    })
}

//~ cairn_quaternion_to_euler
/// Roll, pitch and yaw (rad) of a quaternion; pitch lies in \[-pi/2, pi/2\]. At pitch = +-pi/2 roll and yaw turn about
/// the same axis; there roll is set to 0.
///
/// Complexity: O(1).
///
/// # Errors
///
/// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
pub fn quaternion_to_euler(quaternion: &[f64; 4]) -> Result<[f64; 3]> {
    let [mut roll, mut pitch, mut yaw] = [0.0; 3];
    // SAFETY: an array of four values, and three values.
    call(|error| unsafe {
        sys::cairn_quaternion_to_euler(quaternion.as_ptr(), &mut roll, &mut pitch, &mut yaw, error)
    })?;
    Ok([roll, pitch, yaw])
}

//~ cairn_quaternion_exp
/// Quaternion of a rotation vector (axis times angle, rad).
///
/// Complexity: O(1).
///
/// # Errors
///
/// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
pub fn quaternion_exp(rotation_vector: &[f64; 3]) -> Result<[f64; 4]> {
    // SAFETY: arrays of three and four values.
    get(|quaternion: *mut [f64; 4], error| unsafe {
        sys::cairn_quaternion_exp(rotation_vector.as_ptr(), quaternion.cast(), error)
    })
}

//~ cairn_quaternion_log
/// Rotation vector of a quaternion (rad). Its length is at most pi.
///
/// Complexity: O(1).
///
/// # Errors
///
/// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
pub fn quaternion_log(quaternion: &[f64; 4]) -> Result<[f64; 3]> {
    // SAFETY: arrays of four and three values.
    get(|rotation_vector: *mut [f64; 3], error| unsafe {
        sys::cairn_quaternion_log(quaternion.as_ptr(), rotation_vector.cast(), error)
    })
}
