// SPDX-License-Identifier: BSD-3-Clause
//! Simulated worlds for filters.
use crate::arrays::{fill, gather, get};
use crate::error::{call, Result};
use crate::library::suitable;
use crate::queries::report;
use crate::{Error, Observation, Pose, Preset, Status, StereoHead, Wheels, WorldMotion, WorldOptions, WorldStep};
use cairn_sys as sys;
use std::fmt;
use std::ptr::{null_mut, NonNull};

/// A world with one rover that drives through it.
pub struct World(NonNull<sys::cairn_world>);

// SAFETY: a handle belongs to no thread.
unsafe impl Send for World {}
// SAFETY: const queries of a handle may run side by side; changes take &mut self.
unsafe impl Sync for World {}

impl WorldOptions {
    //~ cairn_world_options_preset
    /// `submap_landmarks` gets the size of submaps that belongs to the preset: 40, or 20 for rows 3 and 4.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn set_preset(&mut self, preset: Preset) -> Result<u32> {
        let mut options = self.c_value();
        // SAFETY: the options state their size; a number is written.
        let submap_landmarks = get(|landmarks, error| unsafe {
            sys::cairn_world_options_preset(&mut options, preset.0, landmarks, error)
        })?;
        *self = WorldOptions::from_c(&options);
        Ok(submap_landmarks)
    }
}

impl World {
    //~ cairn_world_create
    /// Creates a world before its first step.
    ///
    /// Complexity: O(n log n) for n landmarks; memory: 40 bytes for each landmark.
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL): the ground is too rough for four wheels
    pub fn new(options: &WorldOptions) -> Result<World> {
        suitable()?;
        let mut world = null_mut();
        // SAFETY: the library copies the options. A call that succeeds has written a handle.
        call(|error| unsafe { sys::cairn_world_create(&options.c_value(), &mut world, error) })?;
        // SAFETY: as above.
        Ok(World(unsafe { NonNull::new_unchecked(world) }))
    }

    /// Destroys the world, as the end of its life does.
    pub fn close(self) {}

    fn c(&self) -> *const sys::cairn_world {
        self.0.as_ptr()
    }

    //~ cairn_world_next
    /// Returns the next step. Nothing is stored, so memory does not grow with the drive.
    ///
    /// Complexity: O(motions + landmarks in range).
    ///
    //~
    /// [`World::next_step`] tells the end of the drive without an error.
    //~ errors
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_STATE`](crate::Status::ERROR_STATE): there are no more steps
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL): the ground is too rough for four wheels
    pub fn advance(&mut self) -> Result<WorldStep> {
        let world = self.0.as_ptr();
        // SAFETY: the step states its size.
        report(WorldStep::empty_c(), |step, error| unsafe { sys::cairn_world_next(world, step, error) })
            .map(|step| WorldStep::from_c(&step))
    }

    /// [`World::advance`], and `None` after the last step.
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_NUMERICAL`]: the ground is too rough for four wheels
    pub fn next_step(&mut self) -> Result<Option<WorldStep>> {
        at_the_end(self.advance())
    }

    //~ cairn_world_motions
    /// The motion samples of the last step, in order; none before the first step.
    ///
    /// Complexity: O(n).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn motions(&self) -> Result<Vec<WorldMotion>> {
        gather(|motions| self.motions_into(motions))
    }

    /// [`World::motions`] into memory of the caller.
    ///
    /// # Errors
    ///
    /// As [`World::motions`].
    pub fn motions_into(&self, motions: &mut Vec<WorldMotion>) -> Result<()> {
        // SAFETY: the library writes at most `capacity` motions, which have the layout of WorldMotion.
        fill(motions, |first: *mut WorldMotion, capacity, needed, error| unsafe {
            sys::cairn_world_motions(self.c(), first.cast(), capacity, needed, error)
        })
    }

    //~ cairn_world_observations
    /// The observations of the last step's frame, by ascending id, z as [`StereoHead`](crate::StereoHead) defines it,
    /// covariance zero; none before the first step.
    ///
    /// Complexity: O(n).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn observations(&self) -> Result<Vec<Observation>> {
        gather(|observations| self.observations_into(observations))
    }

    /// [`World::observations`] into memory of the caller.
    ///
    /// # Errors
    ///
    /// As [`World::observations`].
    pub fn observations_into(&self, observations: &mut Vec<Observation>) -> Result<()> {
        // SAFETY: the library writes at most `capacity` observations, which have the layout of Observation.
        fill(observations, |first: *mut Observation, capacity, needed, error| unsafe {
            sys::cairn_world_observations(self.c(), first.cast(), capacity, needed, error)
        })
    }

    //~ cairn_world_rewind
    /// Goes back to before the first step. The same drive follows, bit for bit.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn rewind(&mut self) -> Result<()> {
        // SAFETY: the handle only.
        call(|error| unsafe { sys::cairn_world_rewind(self.0.as_ptr(), error) })
    }

    //~ cairn_world_steps
    /// Number of steps, including the start.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn steps(&self) -> Result<usize> {
        // SAFETY: a number is written.
        get(|steps, error| unsafe { sys::cairn_world_steps(self.c(), steps, error) })
    }

    //~ cairn_world_most_observations
    /// Upper bound of the number of observations in a frame, for [`FilterOptions`](crate::FilterOptions).
    ///
    /// Complexity: O(n).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn most_observations(&self) -> Result<usize> {
        // SAFETY: a number is written.
        get(|count, error| unsafe { sys::cairn_world_most_observations(self.c(), count, error) })
    }

    //~ cairn_world_head
    /// The stereo head of the world, to be added to a filter: mount, noise, encoder mode.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn head(&self) -> Result<StereoHead> {
        // SAFETY: the description states its size.
        report(StereoHead::empty_c(), |head, error| unsafe { sys::cairn_world_head(self.c(), head, error) })
            .map(|head| StereoHead::from_c(&head))
    }

    //~ cairn_world_wheels
    /// The wheels of the rover, for [`Filter::set_wheels`](crate::Filter::set_wheels), with the noise of the wheel
    /// rates of one motion sample. The noise of rates that wheels do not measure is that of
    /// [`Wheels::default`](crate::Wheels::default).
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn wheels(&self) -> Result<Wheels> {
        // SAFETY: the description states its size.
        report(Wheels::empty_c(), |wheels, error| unsafe { sys::cairn_world_wheels(self.c(), wheels, error) })
            .map(|wheels| Wheels::from_c(&wheels))
    }

    //~ cairn_world_pose
    /// True pose of the body in the map at `time` (s, 0 to the end of the drive). The origin of the body lies on the
    /// ground in the middle between the wheels.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn pose(&self, time: f64) -> Result<Pose> {
        // SAFETY: a pose is written, which has the layout of Pose.
        get(|pose: *mut Pose, error| unsafe { sys::cairn_world_pose(self.c(), time, pose.cast(), error) })
    }

    //~ cairn_world_contacts
    /// Points at which the wheels touch the ground at `time`: front left, front right, rear left, rear right, x y z
    /// each, in the map, m.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_STATE`](crate::Status::ERROR_STATE): [`Contact::POINT`](crate::Contact::POINT)
    pub fn contacts(&self, time: f64) -> Result<[[f64; 3]; 4]> {
        // SAFETY: twelve values are written.
        get(|points: *mut [[f64; 3]; 4], error| unsafe {
            sys::cairn_world_contacts(self.c(), time, points.cast(), error)
        })
    }

    //~ cairn_world_height
    /// Height of the ground at x, y (m), m.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn height(&self, x: f64, y: f64) -> Result<f64> {
        // SAFETY: a number is written.
        get(|height, error| unsafe { sys::cairn_world_height(self.c(), x, y, height, error) })
    }

    //~ cairn_world_extent
    /// The rectangle in the xy plane that contains the course and all landmarks, m.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn extent(&self) -> Result<([f64; 2], [f64; 2])> {
        let (mut lower, mut upper) = ([0.0; 2], [0.0; 2]);
        // SAFETY: arrays of two values are written.
        call(|error| unsafe { sys::cairn_world_extent(self.c(), lower.as_mut_ptr(), upper.as_mut_ptr(), error) })?;
        Ok((lower, upper))
    }

    //~ cairn_world_landmark
    /// True position (m) of the landmark `id`, 0 to the number of landmarks minus 1.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND)
    pub fn landmark(&self, id: u64) -> Result<[f64; 3]> {
        // SAFETY: three values are written.
        get(|position: *mut [f64; 3], error| unsafe { sys::cairn_world_landmark(self.c(), id, position.cast(), error) })
    }

    //~ cairn_world_landmarks
    /// True positions of all landmarks, x y z each, m, by ascending id.
    ///
    /// Complexity: O(n).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn landmarks(&self) -> Result<Vec<[f64; 3]>> {
        gather(|positions| {
            // SAFETY: the library writes at most `capacity` landmarks of three values.
            fill(positions, |first: *mut [f64; 3], capacity, needed, error| unsafe {
                sys::cairn_world_landmarks(self.c(), first.cast(), capacity, needed, error)
            })
        })
    }
}

/// A step of a drive, or `None` after the last one. The library says "no more steps" by a status of its own.
pub(crate) fn at_the_end<T>(step: Result<T>) -> Result<Option<T>> {
    let over = |error: &Error| error.status() == Status::ERROR_STATE;
    match step {
        Ok(step) => Ok(Some(step)),
        Err(error) if over(&error) => Ok(None),
        Err(error) => Err(error),
    }
}

impl Drop for World {
    //~ cairn_world_destroy
    fn drop(&mut self) {
        // SAFETY: the handle is used for the last time.
        unsafe { sys::cairn_world_destroy(self.0.as_ptr()) }
    }
}

impl fmt::Debug for World {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("World").field("steps", &self.steps().ok()).finish()
    }
}
