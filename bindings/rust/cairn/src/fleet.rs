// SPDX-License-Identifier: BSD-3-Clause
//! A simulated fleet of boats for teams.
use crate::arrays::{fill, gather, get};
use crate::error::{call, Result};
use crate::library::suitable;
use crate::queries::report;
use crate::world::at_the_end;
use crate::{FleetOptions, FleetSighting, FleetStep, FleetVehicle};
use cairn_sys as sys;
use std::fmt;
use std::ptr::{null_mut, NonNull};

/// A square of sea with boats that drive in it.
pub struct Fleet(NonNull<sys::cairn_fleet>);

// SAFETY: a handle belongs to no thread.
unsafe impl Send for Fleet {}
// SAFETY: const queries of a handle may run side by side; changes take &mut self.
unsafe impl Sync for Fleet {}

impl Fleet {
    //~ cairn_fleet_create
    /// Creates a fleet before its first step.
    ///
    /// Each boat is commanded once around a circle of radius R = course_length / (2 pi), anticlockwise, at the constant
    /// speed course_length / duration and rate 2 pi / duration. It starts at the southernmost point of the circle,
    /// heading east. The centres of the circles are `separation` apart. The centre of a single boat is the origin. The
    /// centres of two boats are (-separation / 2, 0) and (separation / 2, 0). The centres of more boats form a square
    /// grid about the origin, with as many columns as rows or one more. They are numbered from west to east and row by
    /// row from the south; a last row that is not full is centred. A grid wider than half of `area` is shrunk to that.
    /// With [`FleetLayout::COAST`](crate::FleetLayout::COAST) all circles must lie south of the coast line.
    ///
    /// Complexity: O(features).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    pub fn new(options: &FleetOptions) -> Result<Fleet> {
        suitable()?;
        let mut fleet = null_mut();
        // SAFETY: the library copies the options. A call that succeeds has written a handle.
        call(|error| unsafe { sys::cairn_fleet_create(&options.c_value(), &mut fleet, error) })?;
        // SAFETY: as above.
        Ok(Fleet(unsafe { NonNull::new_unchecked(fleet) }))
    }

    /// Destroys the fleet, as the end of its life does.
    pub fn close(self) {}

    fn c(&self) -> *const sys::cairn_fleet {
        self.0.as_ptr()
    }

    //~ cairn_fleet_next
    /// Returns the next step. During a period each boat keeps its executed speed and rate, and its true pose is their
    /// exact integral. Then each boat measures all features and all other boats within `radar_range` (true distance,
    /// not 0). Each measurement has its own noise: two boats that see each other have independent errors. Nothing is
    /// stored, so memory does not grow with the drive.
    ///
    /// Complexity: O(vehicles (features + vehicles)).
    ///
    //~
    /// [`Fleet::next_step`] tells the end of the drive without an error.
    //~ errors
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_STATE`](crate::Status::ERROR_STATE): there are no more steps
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY): the next call returns the same step
    pub fn advance(&mut self) -> Result<FleetStep> {
        let fleet = self.0.as_ptr();
        // SAFETY: the step states its size.
        report(FleetStep::empty_c(), |step, error| unsafe { sys::cairn_fleet_next(fleet, step, error) })
            .map(|step| FleetStep::from_c(&step))
    }

    /// [`Fleet::advance`], and `None` after the last step.
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY): the next call returns the same step
    pub fn next_step(&mut self) -> Result<Option<FleetStep>> {
        at_the_end(self.advance())
    }

    //~ cairn_fleet_vehicles
    /// The boats at the end of the last step, boat 1 first; none before the first step.
    ///
    /// Complexity: O(n).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn vehicles(&self) -> Result<Vec<FleetVehicle>> {
        gather(|vehicles| {
            // SAFETY: the library writes at most `capacity` boats, which have the layout of FleetVehicle.
            fill(vehicles, |first: *mut FleetVehicle, capacity, needed, error| unsafe {
                sys::cairn_fleet_vehicles(self.c(), first.cast(), capacity, needed, error)
            })
        })
    }

    //~ cairn_fleet_seen_features
    /// The features that boat `vehicle` (counted from 1) measured in the last step, by ascending id; none before the
    /// first step.
    ///
    /// Complexity: O(n).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND): boat
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn seen_features(&self, vehicle: u64) -> Result<Vec<FleetSighting>> {
        gather(|features| {
            // SAFETY: the library writes at most `capacity` sightings, which have the layout of FleetSighting.
            fill(features, |first: *mut FleetSighting, capacity, needed, error| unsafe {
                sys::cairn_fleet_seen_features(self.c(), vehicle, first.cast(), capacity, needed, error)
            })
        })
    }

    //~ cairn_fleet_seen_vehicles
    /// The other boats that boat `vehicle` (counted from 1) measured in the last step, by ascending id; none before the
    /// first step.
    ///
    /// Complexity: O(n).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND): boat
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn seen_vehicles(&self, vehicle: u64) -> Result<Vec<FleetSighting>> {
        gather(|vehicles| {
            // SAFETY: as in `seen_features`.
            fill(vehicles, |first: *mut FleetSighting, capacity, needed, error| unsafe {
                sys::cairn_fleet_seen_vehicles(self.c(), vehicle, first.cast(), capacity, needed, error)
            })
        })
    }

    //~ cairn_fleet_rewind
    /// Goes back to before the first step. The same steps follow, bit for bit.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn rewind(&mut self) -> Result<()> {
        // SAFETY: the handle only.
        call(|error| unsafe { sys::cairn_fleet_rewind(self.0.as_ptr(), error) })
    }

    //~ cairn_fleet_steps
    /// Number of steps: 1 plus the number of whole periods in the duration.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn steps(&self) -> Result<usize> {
        // SAFETY: a number is written.
        get(|steps, error| unsafe { sys::cairn_fleet_steps(self.c(), steps, error) })
    }

    //~ cairn_fleet_features
    /// True positions of all features, x y each, m; the feature with id 1 is the first.
    ///
    /// Complexity: O(n).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn features(&self) -> Result<Vec<[f64; 2]>> {
        gather(|positions| {
            // SAFETY: the library writes at most `capacity` points of two values.
            fill(positions, |first: *mut [f64; 2], capacity, needed, error| unsafe {
                sys::cairn_fleet_features(self.c(), first.cast(), capacity, needed, error)
            })
        })
    }

    //~ cairn_fleet_coast
    /// The coast line from west to east: a polyline, x y each, m. The land is north of it.
    ///
    /// Complexity: O(n).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn coast(&self) -> Result<Vec<[f64; 2]>> {
        gather(|points| {
            // SAFETY: as in `features`.
            fill(points, |first: *mut [f64; 2], capacity, needed, error| unsafe {
                sys::cairn_fleet_coast(self.c(), first.cast(), capacity, needed, error)
            })
        })
    }
}

impl Drop for Fleet {
    //~ cairn_fleet_destroy
    fn drop(&mut self) {
        // SAFETY: the handle is used for the last time.
        unsafe { sys::cairn_fleet_destroy(self.0.as_ptr()) }
    }
}

impl fmt::Debug for Fleet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Fleet").field("steps", &self.steps().ok()).finish()
    }
}
