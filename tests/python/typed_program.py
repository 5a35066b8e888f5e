# SPDX-License-Identifier: BSD-3-Clause
"""A user's program, for type checkers: what is right passes, and each wrong line is an error (an unused `ignore` is one)."""

import cairn
import numpy as np
from numpy.typing import NDArray


def model(pose: cairn.Pose, landmark: NDArray[np.float64]) -> tuple[NDArray[np.float64], list[list[float]], list[list[float]]]:
    return landmark - pose.position, [[0.0] * 6] * 3, [[0.0] * 3] * 3


def drive() -> float:
    world = cairn.World(seed=3, course="laps", terrain=cairn.Terrain.WAVES)
    options: cairn.FilterOptions = {"max_landmarks": 250, "submap_landmarks": 60, "initial_pose": world.pose(0.0)}
    print(cairn.Filter.required_bytes(state_error=cairn.StateError.STANDARD, join="sparse", initial_pose=((0, 0, 0), (1, 0, 0, 0))))
    with cairn.Filter(**options) as rover:
        camera: int = rover.add_stereo_head(**world.head())
        rover.add_custom(model, rows=3, sigma=[0.1, 0.1, 0.1])
        for step in world:
            for motion in step.motions:
                rover.predict_twist(motion["dt"], motion["velocity"], motion["rate"])
            matches = rover.update(camera, step.observations)
            new = int(np.count_nonzero(matches["result"] == cairn.Result.NEW))
            rover.update(camera, [1, 2, new], [[1, 2, 3]] * 3)
        position, quaternion, covariance = rover.pose()
        near = rover.map.within(position, 30.0)
        health = rover.health()
        if health["verdict"] is cairn.Verdict.LOST or health["reasons"] & cairn.Doubts.JUMP:
            print(health["words"], quaternion, covariance, near["id"])
    return rover.last_update()["nis"]


def team() -> cairn.Packet:
    fleet = cairn.Fleet(features=6, layout="coast")
    boat = cairn.Team(vehicle=1, mode="joint", baseline=True, filter={"max_landmarks": 20}, radar=fleet.radar())
    boat.observe(0.0, fleet.next().vehicles[0].features)
    packet = boat.take_packet()
    return boat.receive(packet or b"")


def wrong() -> None:
    cairn.Filter(max_landmark=3)  # type: ignore[call-arg] # pyright: ignore[reportCallIssue]
    cairn.Filter(max_landmarks="3")  # type: ignore[arg-type] # pyright: ignore[reportArgumentType]
    cairn.Filter(join="spares")  # type: ignore[arg-type] # pyright: ignore[reportArgumentType]
    cairn.Filter().set_loss(0, "hubert")  # type: ignore[arg-type] # pyright: ignore[reportArgumentType]
    print(cairn.Result.NEWS)  # type: ignore[attr-defined] # pyright: ignore
    print(cairn.Filter().health()["verdicts"])  # type: ignore[typeddict-item] # pyright: ignore
    try:
        drive()
    except cairn.CairnError as error:
        status: cairn.Status = error.status
        print(status, error.message)
