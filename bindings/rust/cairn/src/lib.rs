// SPDX-License-Identifier: BSD-3-Clause
//! Landmark SLAM. A vehicle tells a [`Filter`] how it moved and where it saw landmarks. The filter returns the
//! vehicle's pose, a [`Map`] of the landmarks, and covariances that say how far to trust both.
//!
//! ```
//! # #[cfg(feature = "sim")]
//! # fn main() -> cairn::Result<()> {
//! use cairn::{Filter, FilterOptions, World, WorldOptions};
//!
//! // A simulated rover; or your own.
//! let mut world = World::new(&WorldOptions { seed: 3, ..Default::default() })?;
//! let mut rover = Filter::new(&FilterOptions {
//!     submap_landmarks: 60, // close a submap when it holds this many
//!     max_observations: world.most_observations()? as u32,
//!     initial_pose: world.pose(0.0)?,
//!     ..Default::default()
//! })?;
//! let camera = rover.add_stereo_head(&world.head()?)?;
//! while let Some(step) = world.next_step()? {
//!     for motion in world.motions()? {
//!         rover.predict_twist(motion.dt, &motion.velocity, &motion.rate)?;
//!     }
//!     rover.point_head(camera, step.pan, step.stick)?;
//!     rover.update(camera, &world.observations()?)?;
//! }
//! let (pose, covariance) = rover.pose()?;
//! let landmarks = rover.map().within(&pose.position, 30.0)?;
//! # assert!(covariance[0] > 0.0 && !landmarks.is_empty());
//! # Ok(())
//! # }
//! # #[cfg(not(feature = "sim"))]
//! # fn main() {}
//! ```
//!
//! - **Errors**: every call that can fail returns a [`Result`]. An [`Error`] has a [`Status`] and the library's
//!   message. A call that fails changes nothing. A refused observation is not an error: its [`Match`] reports the
//!   refusal.
//! - **Threads**: handles are `Send` and `Sync`. Changes take `&mut self`, queries `&self`, so the compiler refuses
//!   what the library does not allow.
//! - **Memory**: a handle is freed when it is dropped; `close` does the same by name. A map of a filter is borrowed
//!   from the filter; [`Map::copy`] makes one that stays.
//! - **Ids** of landmarks are `u64`. Every value except [`ID_NONE`] is allowed.
//! - **Arrays**: slices go in. Queries return a `Vec`, or fill a `Vec` of the caller (`..._into`), whose memory they
//!   use again. Matrices are row-major.
//! - **Constants** are values of small types ([`Join::SPARSE`]). A newer library may return a value that has no name
//!   here, so a `match` needs a last arm `_`.
//! - **Callbacks** are closures. An error that a closure returns aborts the call and becomes the
//!   [source](std::error::Error::source) of its error. A panic aborts the call, too, and continues in the caller.
#![warn(missing_docs)]
#![deny(unsafe_op_in_unsafe_fn)]

mod arrays;
mod callback;
mod error;
mod filter;
#[cfg(feature = "sim")]
mod fleet;
mod library;
mod map;
mod motion;
mod pose;
mod queries;
mod sensor;
mod submaps;
mod team;
#[rustfmt::skip]
mod types;
mod updates;
#[cfg(feature = "sim")]
mod world;

pub use callback::{Answer, Placement, Prediction};
pub use error::{Error, Result, Source};
pub use filter::Filter;
#[cfg(feature = "sim")]
pub use fleet::Fleet;
#[cfg(feature = "sim")]
pub use library::sim_last_message;
pub use library::{build, has, id_none, last_message, version, version_number};
pub use map::{Map, MapCopy};
pub use pose::{quaternion_exp, quaternion_from_euler, quaternion_log, quaternion_to_euler};
pub use sensor::Sensor;
pub use submaps::Submap;
pub use team::Team;
pub use types::*;
#[cfg(feature = "sim")]
pub use world::World;

/// Covariance of the error `[dp; dtheta]` of a pose: 6 x 6, row-major.
pub type Covariance = [f64; 36];

/// The examples of the README are tested, too.
#[cfg(all(doctest, feature = "sim"))]
#[doc = include_str!("../README.md")]
struct Readme;
