# SPDX-License-Identifier: BSD-3-Clause
"""libcairn_sim: worlds with a rover, fleets of boats, and a filter that drives through a world."""

from .scenario import Scenario


def steps(s, world, count):
    """Steps whose outputs are recorded."""
    for _ in range(count):
        s.call("cairn_world_next", world=world)
        s.call("cairn_world_motions", world=world)
        s.call("cairn_world_observations", world=world)


def step(s, world):
    """A step whose outputs are the inputs of later calls."""
    s.call("cairn_world_next", gives={"step": "$step"}, world=world)
    s.call("cairn_world_motions", gives={"motions": "$motions"}, world=world)
    s.call("cairn_world_observations", gives={"observations": "$frame"}, world=world)


def world():
    s = Scenario("world",
                 "A rover in a world of the paper's kind: steps, truth, terrain, landmarks; then the same again.")
    made = s.call("cairn_world_create", gives={"world": "$world"}, options={"landmarks": 20, "seed": "7"})
    s.call("cairn_world_steps", world=made)
    s.call("cairn_world_most_observations", world=made)
    s.call("cairn_world_motions", world=made)
    s.call("cairn_world_observations", world=made)
    for _ in range(2):
        steps(s, made, 3)
        s.call("cairn_world_rewind", world=made)
    s.call("cairn_world_pose", world=made, time=12.5)
    s.call("cairn_world_contacts", world=made, time=12.5)
    s.call("cairn_world_height", world=made, x=10.0, y=-3.0)
    s.call("cairn_world_extent", world=made)
    s.call("cairn_world_landmark", world=made, id="3")
    s.call("cairn_world_landmarks", world=made)
    s.call("cairn_world_head", world=made)
    s.call("cairn_world_wheels", world=made)
    s.wrong("NOT_FOUND", "cairn_world_landmark", world=made, id="20")
    s.wrong("ARGUMENT", "cairn_world_pose", world=made, time=-1.0)
    s.wrong("ARGUMENT", "cairn_world_height", world=made, x="nan", y=0.0)
    s.call("cairn_world_destroy", world=made)
    return s


KINDS = [
    {"course": "CAIRN_COURSE_CIRCLE", "terrain": "CAIRN_TERRAIN_ROLLING", "contact": "CAIRN_CONTACT_WHEELS",
     "drive": "CAIRN_DRIVE_TWIST", "accelerometer": "CAIRN_ACCELEROMETER_VELOCITY",
     "stick_noise": "CAIRN_STICK_PER_OBSERVATION", "observe_at_start": True, "landmarks": 10},
    {"course": "CAIRN_COURSE_LAPS", "terrain": "CAIRN_TERRAIN_WAVES", "contact": "CAIRN_CONTACT_POINT",
     "drive": "CAIRN_DRIVE_WHEELS_GYRO", "accelerometer": "CAIRN_ACCELEROMETER_ACCELERATION",
     "stick_noise": "CAIRN_STICK_PER_FRAME", "pan_amplitude": 0.5, "stick_amplitude": 0.2, "landmarks": 60},
    {"course": "CAIRN_COURSE_TRAVERSE", "terrain": "CAIRN_TERRAIN_FLAT", "velocity_bias": [0.01, 0.0, 0.0],
     "rate_bias": [0.0, 0.0, 0.001], "wheel_scale": [0.01, -0.01], "mount_turn": [0.0, 0.01, 0.0],
     "mount_shift": [0.1, 0.0, 0.0], "value_offset": [0.2, 0.0, 0.0], "landmarks": 400},
]


def kinds():
    s = Scenario("world_kinds", "Courses, terrains, contacts and noises of worlds, and the presets.")
    for preset in "PAPER", "ROW1", "ROW2", "ROW3", "ROW4":
        s.call("cairn_world_options_preset", options={"seed": "5"}, preset="CAIRN_PRESET_" + preset)
    for number, options in enumerate(KINDS):
        made = s.call("cairn_world_create", gives={"world": f"$world{number}"}, options={"seed": "3", **options})
        steps(s, made, 3)
    s.wrong("STATE", "cairn_world_contacts", world="$world1", time=1.0)
    return s


def drive():
    s = Scenario("world_drive", "A filter drives through a world: its inputs are outputs of the simulator.")
    made = s.call("cairn_world_create", gives={"world": "$world"}, options={"landmarks": 40, "seed": "9"})
    s.call("cairn_world_pose", gives={"pose": "$start"}, world=made, time=0.0)
    s.call("cairn_world_head", gives={"head": "$head"}, world=made)
    s.call("cairn_world_wheels", gives={"wheels": "$wheels"}, world=made)
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"initial_pose": "$start", "max_observations": 40, "submap_landmarks": 15})
    s.call("cairn_filter_add_stereo_head", filter=rover, head="$head")
    s.call("cairn_filter_set_wheels", filter=rover, wheels="$wheels")
    step(s, made)
    for _ in range(8):
        step(s, made)
        s.call("cairn_filter_set_twist_noise", filter=rover,
               noise={"velocity_sigma": "$step.velocity_sigma", "rate_sigma": "$step.rate_sigma"})
        for sample in range(10):
            s.call("cairn_filter_predict_twist", filter=rover, dt=f"$motions.{sample}.dt",
                   velocity=f"$motions.{sample}.velocity", rate=f"$motions.{sample}.rate")
        s.call("cairn_filter_point_head", filter=rover, sensor=0, pan="$step.pan", stick="$step.stick")
        s.call("cairn_filter_update", filter=rover, sensor=0, observations="$frame")
        s.call("cairn_filter_pose", filter=rover)
    s.call("cairn_filter_pose_nees", filter=rover, truth="$step.truth")
    return s


def wrong_world():
    s = Scenario("world_wrong", "Worlds that cannot be made, and the end of a drive.")
    for options in ({"landmarks": 0}, {"speed": 0.0}, {"strip": -1.0}, {"radius": 10.0}, {"max_slope": 2.0},
                    {"range_sigma": "nan"}, {"far_range": 1.0}, {"motion_period": 0.07}, {"half_azimuth": 4.0},
                    {"wheel_scale": [-1.5, 0.0]}, {"laps": -1.0}, {"round_length": 0.0}, {"round_variation": 0.5},
                    {"landmark_area": 0.0}, {"velocity_sigma": -0.1}, {"gravity": "inf"}):
        s.wrong("ARGUMENT", "cairn_world_create", options=options)
    made = s.call("cairn_world_create", gives={"world": "$world"},
                  options={"landmarks": 200, "frame_period": 200.0, "terrain": "CAIRN_TERRAIN_FLAT"})
    s.call("cairn_world_steps", world=made)
    for _ in range(3):
        s.call("cairn_world_next", gives={"step": "$step"}, world=made)
    s.wrong("STATE", "cairn_world_next", world=made)
    s.wrong("ARGUMENT", "cairn_world_pose", world=made, time=1e6)
    return s


def fleet():
    s = Scenario("fleet",
                 "Two boats in a uniform sea and three along a coast: steps, sightings, features, coast lines.")
    for name, options in (("$sea", {"seed": "3", "features": 6, "layout": "CAIRN_FLEET_UNIFORM"}),
                          ("$coast", {"seed": "4", "features": 8, "vehicles": 3, "layout": "CAIRN_FLEET_COAST"})):
        made = s.call("cairn_fleet_create", gives={"fleet": name}, options=options)
        s.call("cairn_fleet_steps", fleet=made)
        s.call("cairn_fleet_vehicles", fleet=made)
        for _ in range(2):
            for _ in range(2):
                s.call("cairn_fleet_next", fleet=made)
                s.call("cairn_fleet_vehicles", fleet=made)
                for vehicle in range(1, options.get("vehicles", 2) + 1):
                    s.call("cairn_fleet_seen_features", fleet=made, vehicle=str(vehicle))
                    s.call("cairn_fleet_seen_vehicles", fleet=made, vehicle=str(vehicle))
            s.call("cairn_fleet_rewind", fleet=made)
        s.call("cairn_fleet_features", fleet=made)
        s.call("cairn_fleet_coast", fleet=made)
    s.wrong("NOT_FOUND", "cairn_fleet_seen_features", fleet="$sea", vehicle="3")
    s.wrong("NOT_FOUND", "cairn_fleet_seen_vehicles", fleet="$sea", vehicle="0")
    s.call("cairn_fleet_destroy", fleet="$sea")
    return s


def wrong_fleet():
    s = Scenario("fleet_wrong", "Fleets that cannot be made, and the end of a drive.")
    for options in ({"vehicles": 0}, {"features": 0}, {"area": -1.0}, {"separation": 6000.0},
                    {"course_length": 20000.0},
                    {"period": 2000.0}, {"range_sigma": "inf"}, {"coast_distance": 0.6}, {"coast_relief": 0.4},
                    {"coast_strip": 0.6},
                    {"layout": "CAIRN_FLEET_COAST", "coast_distance": 0.01, "coast_relief": 0.0}):
        s.wrong("ARGUMENT", "cairn_fleet_create", options=options)
    made = s.call("cairn_fleet_create", gives={"fleet": "$short"}, options={"duration": 10.0})
    for _ in range(3):
        s.call("cairn_fleet_next", fleet=made)
    s.wrong("STATE", "cairn_fleet_next", fleet=made)
    return s


SCENARIOS = [world, kinds, drive, wrong_world, fleet, wrong_fleet]
