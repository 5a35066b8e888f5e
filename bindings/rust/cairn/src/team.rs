// SPDX-License-Identifier: BSD-3-Clause
//! Teams of planar vehicles that exchange packets.
use crate::arrays::{fill, first, gather, get, pointer};
use crate::error::{call, Result};
use crate::library::suitable;
use crate::queries::{posed, report};
use crate::{
    Covariance, FilterOptions, Map, Match, Observation, Packet, Pose, RangeBearing, TeamOptions, TeamReport, TwistNoise,
};
use cairn_sys as sys;
use std::fmt;
use std::ptr::{null, null_mut, NonNull};

/// One vehicle's view of its team. Packets are bytes; any transport can carry them.
pub struct Team(NonNull<sys::cairn_team>);

// SAFETY: a handle belongs to no thread.
unsafe impl Send for Team {}
// SAFETY: const queries of a handle may run side by side; changes take &mut self.
unsafe impl Sync for Team {}

impl Team {
    //~ cairn_team_create
    /// Creates a vehicle's view of its team. `filter` holds the options of the filter that the team runs: `vehicle`
    /// must be [`Vehicle::PLANAR`](crate::Vehicle::PLANAR), `initial_pose` is the start of this vehicle in the frame of
    /// the team, and `submap_landmarks` must be greater than 0 in mode [`TeamMode::SUBMAPS`](crate::TeamMode::SUBMAPS)
    /// and 0 in all other modes. `radar` is the sensor of all vehicles. With extended observations it must be mounted
    /// at the body's origin.
    ///
    /// Complexity: O(memory).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    pub fn new(options: &TeamOptions, filter: &FilterOptions, radar: &RangeBearing) -> Result<Team> {
        suitable()?;
        let mut team = null_mut();
        // SAFETY: the library copies the options. A call that succeeds has written a handle.
        call(|error| unsafe {
            sys::cairn_team_create(&options.c_value(), &filter.c_value(), &radar.c_value(), &mut team, error)
        })?;
        // SAFETY: as above.
        Ok(Team(unsafe { NonNull::new_unchecked(team) }))
    }

    /// Destroys the team, as the end of its life does. [`Team::leave`] tells the teammates.
    pub fn close(self) {}

    fn c(&self) -> *const sys::cairn_team {
        self.0.as_ptr()
    }

    fn change(
        &mut self,
        change: impl FnOnce(*mut sys::cairn_team, *mut sys::cairn_error) -> sys::cairn_status,
    ) -> Result<()> {
        call(|error| change(self.0.as_ptr(), error))
    }

    //~ cairn_team_add
    /// Adds a teammate. `start` is its pose before its first packet, and `covariance` (6x6; `None`: known exactly) the
    /// covariance of the error of `start`. Both must be the values that the teammate itself starts with. `start`
    /// `None`: the start is unknown. It is solved from the first mutual sighting, at one time, between the teammate and
    /// a vehicle whose pose is known. Modes with extended observations need no start.
    ///
    /// Complexity: O(n).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT): also a teammate that exists, and in mode
    ///   [`TeamMode::SUBMAPS`](crate::TeamMode::SUBMAPS) one that was removed, for its submaps are in the map
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY)
    /// - [`Status::ERROR_STATE`](crate::Status::ERROR_STATE): mode [`TeamMode::SUBMAPS`](crate::TeamMode::SUBMAPS) and
    ///   no start
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    pub fn add(&mut self, vehicle: u64, start: Option<&Pose>, covariance: Option<&Covariance>) -> Result<()> {
        // SAFETY: a pose and 36 values, or null.
        self.change(|team, error| unsafe {
            sys::cairn_team_add(team, vehicle, pointer(start), pointer(covariance), error)
        })
    }

    //~ cairn_team_remove
    /// Removes a teammate: the team neither waits for it nor uses its packets any more. The information from its
    /// earlier packets stays.
    ///
    /// Complexity: O(waiting packets).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT): this vehicle
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND)
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    pub fn remove(&mut self, vehicle: u64) -> Result<()> {
        // SAFETY: numbers only.
        self.change(|team, error| unsafe { sys::cairn_team_remove(team, vehicle, error) })
    }

    //~ cairn_team_members
    /// Numbers of the vehicles of the team, this vehicle's number first.
    ///
    /// Complexity: O(vehicles).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn members(&self) -> Result<Vec<u64>> {
        gather(|vehicles| {
            // SAFETY: the library writes at most `capacity` numbers.
            fill(vehicles, |first, capacity, needed, error| unsafe {
                sys::cairn_team_members(self.c(), first, capacity, needed, error)
            })
        })
    }

    //~ cairn_team_predict_increment
    /// Moves this vehicle by a relative pose, like [`Filter::predict_increment`](crate::Filter::predict_increment). The
    /// teammates learn of this motion by the packet of the next [`Team::observe`](crate::Team::observe).
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL): more than 1e9 m, or noise of more than 1e9 m or a
    ///   whole turn
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY): 65535 motions without an observation
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    pub fn predict_increment(&mut self, t_before_after: &Pose, covariance: &Covariance) -> Result<()> {
        // SAFETY: a pose and 36 values.
        self.change(|team, error| unsafe {
            sys::cairn_team_predict_increment(team, t_before_after.c(), covariance.as_ptr(), error)
        })
    }

    //~ cairn_team_predict_twist
    /// Moves this vehicle by its body velocity (m/s) and body rate (rad/s) over `dt` seconds (> 0). `noise` `None`:
    /// that of [`TwistNoise::default`](crate::TwistNoise::default).
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL)
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY)
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    pub fn predict_twist(
        &mut self,
        dt: f64,
        velocity: &[f64; 3],
        rate: &[f64; 3],
        noise: Option<&TwistNoise>,
    ) -> Result<()> {
        let noise = noise.map(TwistNoise::c_value);
        let noise = noise.as_ref().map_or(null(), |noise| noise as *const sys::cairn_twist_noise);
        // SAFETY: arrays of three values; the library reads the noise.
        self.change(|team, error| unsafe {
            sys::cairn_team_predict_twist(team, dt, velocity.as_ptr(), rate.as_ptr(), noise, error)
        })
    }

    //~ cairn_team_observe
    /// Ends a step of this vehicle at `time` with its scan. `time` is in s, by a clock that all vehicles share, and
    /// must be later than the last one. The scan is ranges and bearings of `landmarks`, by their ids, and of
    /// `vehicles`, by their numbers; both may be empty. Motion and scan become a packet for
    /// [`Team::take_packet`](crate::Team::take_packet). The filter is updated by the step when the packets of all
    /// teammates up to this time have arrived; the order is the same at every vehicle. If the update by this vehicle's
    /// scan fails, the call fails, but the packet is sent all the same. A time that is more than `max_jump` after the
    /// last one is refused, and the motions are kept for the next call. If the next call has a later time, by at most
    /// `max_jump`, both were right, and it succeeds.
    ///
    /// Complexity: O(n^2 m) for n states and m rows of each vehicle.
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT): also a time in the past, an id or a number twice,
    ///   [`ID_NONE`](crate::ID_NONE), this vehicle's number
    /// - [`Status::ERROR_CAPACITY`](crate::Status::ERROR_CAPACITY)
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL)
    /// - [`Status::ERROR_STATE`](crate::Status::ERROR_STATE): the vehicle has left the team
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    pub fn observe(&mut self, time: f64, landmarks: &[Observation], vehicles: &[Observation]) -> Result<()> {
        let (landmark, landmark_count) = (first(landmarks).cast(), landmarks.len());
        let (vehicle, vehicle_count) = (first(vehicles).cast(), vehicles.len());
        // SAFETY: arrays of the stated lengths, with the layout of C.
        self.change(|team, error| unsafe {
            sys::cairn_team_observe(team, time, landmark, landmark_count, vehicle, vehicle_count, error)
        })
    }

    //~ cairn_team_decisions
    /// Matches of the last scan of this vehicle that updated the filter: those of landmarks, then those of vehicles, by
    /// their ids, in the order in which they were processed.
    ///
    /// Complexity: O(matches).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn decisions(&self) -> Result<Vec<Match>> {
        gather(|matches| {
            // SAFETY: the library writes at most `capacity` matches, which have the layout of Match.
            fill(matches, |first: *mut Match, capacity, needed, error| unsafe {
                sys::cairn_team_decisions(self.c(), first.cast(), capacity, needed, error)
            })
        })
    }

    //~ cairn_team_leave
    /// Leaves the team: makes a last packet, the farewell, after which the teammates do not wait for this vehicle any
    /// more. Own steps are then refused. Packets of teammates are still used.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_STATE`](crate::Status::ERROR_STATE): the vehicle has already left
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    pub fn leave(&mut self) -> Result<()> {
        // SAFETY: the handle only.
        self.change(|team, error| unsafe { sys::cairn_team_leave(team, error) })
    }

    //~ cairn_team_take_packet
    /// Takes the next packet that is to be sent to all teammates: a step of this vehicle, a repetition that a teammate
    /// asked for, or a request for missing packets. `needed` gets its size in bytes, 0 if there is no packet. The
    /// packet leaves the queue when it was copied. Own steps wait until they are taken. A packet that was asked for
    /// waits once, however often it was asked for, and so does the request to each teammate: beside own steps the queue
    /// holds at most `history` repetitions and `max_vehicles` requests.
    ///
    /// Complexity: O(size of the packet).
    ///
    //~
    /// In Rust `None` says that there is no packet.
    //~ errors
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_BUFFER`](crate::Status::ERROR_BUFFER)
    pub fn take_packet(&mut self) -> Result<Option<Vec<u8>>> {
        let packet = gather(|packet| self.take_packet_into(packet))?;
        Ok(if packet.is_empty() { None } else { Some(packet) })
    }

    /// [`Team::take_packet`] into memory of the caller, which is empty if there is no packet.
    ///
    /// # Errors
    ///
    /// As [`Team::take_packet`].
    pub fn take_packet_into(&mut self, packet: &mut Vec<u8>) -> Result<()> {
        let team = self.0.as_ptr();
        // SAFETY: the library writes at most `capacity` bytes.
        fill(packet, |first, capacity, needed, error| unsafe {
            sys::cairn_team_take_packet(team, first, capacity, needed, error)
        })
    }

    //~ cairn_team_ask
    /// Asks the teammates for all missing packets. The team does so itself when it finds a gap at a step of this
    /// vehicle; call this function at the end of a mission or after a long silence.
    ///
    /// Complexity: O(missing packets).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY): mode [`TeamMode::SUBMAPS`](crate::TeamMode::SUBMAPS)
    pub fn ask(&mut self) -> Result<()> {
        // SAFETY: the handle only.
        self.change(|team, error| unsafe { sys::cairn_team_ask(team, error) })
    }

    //~ cairn_team_receive
    /// Receives a packet of a teammate. Packets may come late, repeatedly and in any order. `result` gets one of the
    /// `CAIRN_PACKET_` constants. A refused packet is counted and changes nothing; the call succeeds all the same.
    ///
    /// Complexity: O(n^2 m) for n states and m rows of each packet that has its turn.
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    pub fn receive(&mut self, packet: &[u8]) -> Result<Packet> {
        let mut result = 0;
        // SAFETY: bytes of the stated number; a number is written.
        self.change(|team, error| unsafe {
            sys::cairn_team_receive(team, first(packet), packet.len(), &mut result, error)
        })?;
        Ok(Packet(result))
    }

    //~ cairn_team_pose
    /// Pose of a vehicle of the team, and the covariance of its error \[dp; dtheta\] (6x6 row-major). The own pose is
    /// the present one: it includes the motions of own steps that still wait for teammates, but not their scans. The
    /// pose of a teammate is that of its last packet that is part of the estimate; only the modes
    /// [`TeamMode::JOINT`](crate::TeamMode::JOINT) and [`TeamMode::SUBMAPS`](crate::TeamMode::SUBMAPS) have it.
    ///
    /// Complexity: O(own motions that wait for teammates).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NOT_FOUND`](crate::Status::ERROR_NOT_FOUND): not in the team, or its pose is unknown
    pub fn pose(&self, vehicle: u64) -> Result<(Pose, Covariance)> {
        // SAFETY: a pose and 36 values are written.
        posed(|pose, covariance, error| unsafe { sys::cairn_team_pose(self.c(), vehicle, pose, covariance, error) })
    }

    //~ cairn_team_pose_nees
    /// Normalised estimation error squared (NEES) of this vehicle's pose against the true pose, in the error
    /// coordinates of the filter. The pose is the one that [`Team::pose`](crate::Team::pose) returns. A consistent
    /// filter has 3 on average.
    ///
    /// Complexity: O(own motions that wait for teammates).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_NUMERICAL`](crate::Status::ERROR_NUMERICAL): the covariance of this pose is singular, as it is
    ///   at a known start
    pub fn pose_nees(&self, truth: &Pose) -> Result<f64> {
        // SAFETY: a number is written.
        get(|nees, error| unsafe { sys::cairn_team_pose_nees(self.c(), truth.c(), nees, error) })
    }

    //~ cairn_team_map
    /// The team's map. The team owns this map; it lives as long as the team and follows it.
    ///
    /// Complexity: O(1).
    pub fn map(&self) -> &Map {
        // SAFETY: the map lives as long as the team, and no call changes the team while the map is borrowed.
        unsafe { Map::borrowed(sys::cairn_team_map(self.c())) }
    }

    //~ cairn_team_score
    /// Compares the present pose of this vehicle with the true pose. With the option `baseline` it compares the pose of
    /// the second filter, too. [`Team::last_report`](crate::Team::last_report) returns the means.
    ///
    /// Complexity: O(own motions that wait for teammates).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn score(&mut self, truth: &Pose) -> Result<()> {
        // SAFETY: a pose.
        self.change(|team, error| unsafe { sys::cairn_team_score(team, truth.c(), error) })
    }

    //~ cairn_team_last_report
    /// Reports on the team so far.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn last_report(&self) -> Result<TeamReport> {
        // SAFETY: the report states its size.
        report(TeamReport::empty_c(), |report, error| unsafe { sys::cairn_team_last_report(self.c(), report, error) })
            .map(|report| TeamReport::from_c(&report))
    }
}

impl Drop for Team {
    //~ cairn_team_destroy
    fn drop(&mut self) {
        // SAFETY: the handle is used for the last time.
        unsafe { sys::cairn_team_destroy(self.0.as_ptr()) }
    }
}

impl fmt::Debug for Team {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Team").field("members", &self.members().ok()).finish()
    }
}
