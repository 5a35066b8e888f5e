# SPDX-License-Identifier: BSD-3-Clause
"""Teams that exchange packets, fleets, and planar filters."""
import struct
import unittest

import support
import cairn
import numpy as np

PACKET = struct.Struct("<4sHHI")  # magic, version, kind, size


class Boats:
    """One team for each boat of a fleet, each with a post box for the packets of the others."""

    def __init__(self, mode="joint", vehicles=2, starts=True, baseline=0, **options):
        self.fleet = cairn.Fleet(vehicles=vehicles, seed=options.pop("seed", 5), features=options.pop("features", 10),
                                 duration=options.pop("duration", 300.0))
        first = self.fleet.next()
        self.starts = [boat.truth for boat in first.vehicles]
        self.teams = []
        for own in range(vehicles):
            team = cairn.Team(vehicle=own + 1, mode=mode, baseline=baseline, radar=self.fleet.radar(),
                              filter={"max_landmarks": 40, "max_observations": 64, "initial_pose": self.starts[own],
                                      "gate_probability": 1.0, "batch_gate_probability": 1.0}, **options)
            for other in range(vehicles):
                if other != own:
                    team.add(other + 1, self.starts[other] if starts else None)
            self.teams.append(team)

    def drive(self, step):
        for team, boat in zip(self.teams, step.vehicles):
            if step.dt > 0:
                team.predict_twist(step.dt, (boat.speed, 0, 0), (0, 0, boat.rate), **self.fleet.twist_noise())
            team.observe(step.time, boat.features, boat.vehicles)

    def packets(self):
        """The packets of all boats: (sender, bytes)."""
        return [(sender, packet) for sender, team in enumerate(self.teams) for packet in team.packets()]

    def deliver(self, packets):
        return [team.receive(packet) for sender, packet in packets
                for receiver, team in enumerate(self.teams) if receiver != sender]

    def settle(self):
        """Delivers packets until no boat has another one."""
        told = self.packets()
        while told:
            self.deliver(told)
            told = self.packets()

    def state(self, team):
        numbers = [team.pose(int(v)) for v in sorted(team.members())]
        landmarks = team.map.landmarks()
        return b"".join(part.tobytes() for pose in numbers for part in pose) + landmarks["position"].tobytes() + \
            landmarks["covariance"].tobytes()


class TeamTest(unittest.TestCase):
    def test_two_boats_agree_and_gain(self):
        boats = Boats(baseline=1)
        for step in boats.fleet:
            boats.drive(step)
            results = boats.deliver(boats.packets())
            self.assertEqual(set(results), {cairn.Packet.TAKEN})
            for team, boat in zip(boats.teams, step.vehicles):
                team.score(boat.truth)
                if step.time == 0:
                    with self.assertRaisesRegex(cairn.CairnError, "singular"):  # the start is known exactly
                        team.pose_nees(boat.truth)
        self.assertLess(boats.teams[0].pose_nees(step.vehicles[0].truth), 20)
        a, b = boats.teams
        np.testing.assert_array_equal(a.map.landmarks()["id"], b.map.landmarks()["id"])
        for vehicle in (1, 2):  # equal up to rounding: a computes in the frame of its own vehicle, b from a teammate
            for mine, theirs in zip(a.pose(vehicle), b.pose(vehicle)):
                np.testing.assert_allclose(mine, theirs, rtol=1e-9, atol=1e-9)
        for one in range(2):
            report = boats.teams[one].report()
            self.assertEqual((report["sent"], report["taken"], report["received"]), (61, 61, 61))
            self.assertEqual((report["unsettled"], report["lost"], report["failed"]), (0, 0, 0))
            self.assertEqual(report["scored"], 61)
            self.assertGreater(report["claimed_improvement"], 0.1)
            self.assertGreater(report["sightings_used"], 60)
        position, quaternion, covariance = a.pose()
        self.assertEqual((position.shape, quaternion.shape, covariance.shape), ((3,), (4,), (6, 6)))
        self.assertEqual((position[2], quaternion[1], quaternion[2]), (0.0, 0.0, 0.0))
        self.assertTrue((covariance[2:5] == 0).all() and (covariance[:, 2:5] == 0).all())
        last = step.vehicles[0].truth
        self.assertLess(np.linalg.norm(position - last.position), 5 * np.sqrt(covariance[0, 0] + covariance[1, 1]))
        seen = a.decisions()
        self.assertEqual(len(seen), len(step.vehicles[0].features) + len(step.vehicles[0].vehicles))
        self.assertEqual(set(seen["result"].tolist()), {cairn.Result.MATCHED})

    def test_a_bad_transport_changes_nothing(self):
        """Packets that come late, twice, out of order, or only on request give the same bits."""
        good, bad = Boats(max_lag=1e6, vehicles=3), Boats(max_lag=1e6, vehicles=3)
        for step in good.fleet:
            good.drive(step)
            good.settle()
        draw, held = support.random(3), []
        for step in bad.fleet:
            bad.drive(step)
            held += bad.packets()
            draw.shuffle(held)
            now, held = held[: len(held) // 2], held[len(held) // 2:]
            now = [entry for entry in now if draw.rand() > 0.2]  # lost
            bad.deliver(now + now[:1])
        bad.deliver(held)
        for _ in range(20):
            for team in bad.teams:
                team.ask()
            bad.settle()
        for one, other in zip(good.teams, bad.teams):
            self.assertEqual(good.state(one), bad.state(other))
        reports = [team.report() for team in bad.teams]
        for name in ("reordered", "repeated", "requested", "resent"):
            self.assertGreater(sum(report[name] for report in reports), 0, name)
        self.assertEqual([report["unsettled"] for report in reports], [0, 0, 0])

    def test_corrupt_packets_are_told_apart(self):
        boats = Boats()
        step = boats.fleet.next()
        boats.drive(step)
        a, b = boats.teams
        (_, packet), = [entry for entry in boats.packets() if entry[0] == 0]
        self.assertEqual(PACKET.unpack_from(packet), (b"CRNP", 1, 1, len(packet)))
        before = boats.state(b)
        for damaged, result in ((packet[:-1], cairn.Packet.CUT), (packet + b"x", cairn.Packet.CUT),
                                (b"hello", cairn.Packet.FOREIGN), (b"", cairn.Packet.FOREIGN),
                                (packet[:4] + b"\2\0" + packet[6:], cairn.Packet.VERSION),
                                (packet[:40] + bytes([packet[40] ^ 1]) + packet[41:], cairn.Packet.CORRUPT)):
            self.assertEqual(b.receive(damaged), result)
        self.assertEqual(boats.state(b), before)
        self.assertEqual(a.receive(packet), cairn.Packet.OWN)
        self.assertEqual(b.receive(bytearray(packet)), cairn.Packet.TAKEN)
        self.assertEqual(b.receive(memoryview(packet)), cairn.Packet.REPEATED)
        report = b.report()
        self.assertEqual((report["cut"], report["foreign"], report["version"], report["corrupt"]), (2, 2, 1, 1))
        with cairn.Team(vehicle=9) as stranger:
            self.assertEqual(stranger.receive(packet), cairn.Packet.UNKNOWN)

    def test_an_unknown_start_is_found(self):
        boats = Boats(starts=False)
        with self.assertRaisesRegex(cairn.CairnError, "NOT_FOUND"):
            boats.teams[0].pose(2)
        for step in boats.fleet:
            boats.drive(step)
            boats.settle()
        for own, other in ((0, 2), (1, 1)):
            position, _, covariance = boats.teams[own].pose(other)
            self.assertEqual(boats.teams[own].report()["vehicles_found"], 1)
            off = position - step.vehicles[other - 1].truth.position
            self.assertLess(np.linalg.norm(off), 5 * np.sqrt(covariance[0, 0] + covariance[1, 1]))

    def test_joining_and_leaving(self):
        boats = Boats(vehicles=3, max_lag=1e6)
        a, b, c = boats.teams
        self.assertEqual(a.members().tolist(), [1, 2, 3])
        for step in boats.fleet:
            boats.drive(step)
            boats.settle()
            if step.number == 10:
                break
        c.leave()
        boats.settle()
        self.assertEqual(sorted(a.members().tolist()), [1, 2])
        boats.teams = [a, b]
        step = boats.fleet.next()
        boats.drive(step)
        boats.settle()  # nobody waits for c
        self.assertEqual(a.report()["unsettled"], 0)
        with self.assertRaisesRegex(cairn.CairnError, "NOT_FOUND"):
            a.pose(3)
        a.add(3, step.vehicles[2].truth)
        a.remove(3)
        self.assertEqual(a.members().tolist(), [1, 2])

    def test_waiting_is_told_and_motion_counts_at_once(self):
        boats = Boats()
        a = boats.teams[0]
        start = a.pose()[0]
        a.observe(0.0)
        self.assertEqual(a.report()["unsettled"], 1)
        a.predict_increment(((2.0, 1.0, 0.0), (1.0, 0, 0, 0)), np.diag([0.1, 0.2, 0, 0, 0, 0.01]))
        moved, _, covariance = a.pose()
        np.testing.assert_allclose(moved - start, [2, 1, 0], atol=1e-9)  # it heads east
        np.testing.assert_allclose(np.diag(covariance), [0.1, 0.2, 0, 0, 0, 0.01], atol=1e-9)

    def test_modes_and_their_words(self):
        gains = {}
        for mode in ("mono", "eo_diagonal", "eo_full", "joint"):
            boats = Boats(mode=mode, baseline=1)
            for step in boats.fleet:
                boats.drive(step)
                boats.deliver(boats.packets())
                boats.teams[0].score(step.vehicles[0].truth)
            gains[mode] = boats.teams[0].report()["claimed_improvement"]
        self.assertEqual(gains["mono"], 0.0)
        self.assertTrue(0 < gains["eo_full"] < gains["joint"], gains)
        with self.assertRaisesRegex(ValueError, "mode: must be one of 'mono'"):
            cairn.Team(mode="flying")

    def test_bad_input(self):
        boats = Boats()
        a = boats.teams[0]
        a.observe(0.0)
        z = [[100.0, 0.1]]
        for call, word in ((lambda: a.observe(0.0), "ARGUMENT: time"), (lambda: a.observe(float("nan")), "time"),
                           (lambda: a.observe(1.0, vehicles=([1], z)), "this vehicle itself"),
                           (lambda: a.observe(1.0, ([4, 4], z * 2)), "twice"),
                           (lambda: a.observe(1.0, ([4], [[-1.0, 0.0]])), "negative"),
                           (lambda: a.observe(1.0, (range(65), z * 65)), "CAPACITY"),
                           (lambda: a.predict_twist(0.0, (0, 0, 0), (0, 0, 0)), "dt"),
                           (lambda: a.predict_increment(((0, 0, 0), (1, 0, 0, 0)), -np.eye(6)), "covariance"),
                           (lambda: a.add(1), "already"), (lambda: a.add(cairn.ID_NONE), "ARGUMENT"),
                           (lambda: a.remove(1), "this vehicle itself"), (lambda: a.remove(7), "NOT_FOUND"),
                           (lambda: a.pose(7), "NOT_FOUND"), (lambda: cairn.Team(max_lag=0.0), "max_lag"),
                           (lambda: cairn.Team(filter={"vehicle": "spatial"}), "PLANAR"),
                           (lambda: cairn.Team(filter={"submap_landmarks": 5}), "submap_landmarks"),
                           (lambda: cairn.Team(max_vehicles=1).add(5), "CAPACITY")):
            with self.assertRaisesRegex(cairn.CairnError, word):
                call()
        for call, error, word in ((lambda: cairn.Team(speed=3), TypeError, "no option 'speed'"),
                                  (lambda: cairn.Team(radar={"colour": 1}), TypeError, "no option 'colour'"),
                                  (lambda: a.observe(1.0, ([1, 2], z)), ValueError, "z: shape"),
                                  (lambda: a.observe(1.0, ([1],)), TypeError, "landmarks"),
                                  (lambda: a.observe(1.0, vehicles=([-1], z)), ValueError, "ids"),
                                  (lambda: a.add(5, covariance=np.eye(6)), TypeError, "start"),
                                  (lambda: a.predict_twist(1.0, (0, 0), (0, 0, 0)), ValueError, "velocity"),
                                  (lambda: a.receive("text"), TypeError, "")):
            with self.assertRaisesRegex(error, word):
                call()
        self.assertEqual(a.report()["sent"], 1)  # refused observations are not sent
        landmarks = a.map
        a.close()
        for call in (a.report, a.pose, a.packets().__next__, lambda: len(landmarks)):
            with self.assertRaisesRegex(cairn.CairnError, "the team is closed"):
                call()


class FleetTest(unittest.TestCase):
    def test_what_is_told_is_true(self):
        fleet = cairn.Fleet(seed=2, vehicles=3, features=6, range_sigma=1e-6, bearing_sigma=1e-9, layout="coast")
        self.assertEqual(fleet.features().shape, (6, 2))
        self.assertEqual(fleet.coast().shape[1], 2)
        steps = list(fleet)
        self.assertEqual((len(steps), steps[0].dt, steps[-1].time), (len(fleet), 0.0, 1500.0))
        again = list(fleet)
        self.assertEqual(again[7].vehicles[2].features.tobytes(), steps[7].vehicles[2].features.tobytes())
        boat = steps[100].vehicles[0]
        heading = 2 * np.arctan2(boat.truth.quaternion[3], boat.truth.quaternion[0])
        for seen, where in ((boat.features, {i + 1: p for i, p in enumerate(fleet.features())}),
                            (boat.vehicles, {i + 1: b.truth.position[:2] for i, b in enumerate(steps[100].vehicles)})):
            self.assertGreater(len(seen), 0)
            for sight in seen:
                off = where[int(sight["id"])] - boat.truth.position[:2]
                self.assertAlmostEqual(sight["z"][0], np.hypot(*off), places=3)
                turned = np.arctan2(off[1], off[0]) - heading - sight["z"][1]
                self.assertAlmostEqual((turned + np.pi) % (2 * np.pi) - np.pi, 0.0, places=6)
        fleet.rewind()
        for _ in range(len(fleet)):
            fleet.next()
        with self.assertRaises(StopIteration):
            fleet.next()

    def test_bad_input(self):
        with self.assertRaisesRegex(cairn.CairnError, "ARGUMENT"):
            cairn.Fleet(vehicles=0)
        with self.assertRaisesRegex(TypeError, "no option 'boats'"):
            cairn.Fleet(boats=2)
        fleet = cairn.Fleet()
        fleet.close()
        with self.assertRaisesRegex(cairn.CairnError, "the fleet is closed"):
            fleet.features()


class PlaneTest(unittest.TestCase):
    PLACES = {3: (10.0, 4.0), 4: (-5.0, 8.0), 9: (6.0, -7.0)}

    def seen(self, pose, ids=(3, 4, 9)):
        heading = 2 * np.arctan2(pose.quaternion[3], pose.quaternion[0])
        off = np.array([self.PLACES[i] for i in ids]) - pose.position[:2]
        return np.column_stack([np.hypot(*off.T), np.arctan2(off[:, 1], off[:, 0]) - heading])

    def test_a_radar(self):
        start = cairn.planar_pose(1.0, 2.0, 0.5)
        with cairn.Filter(vehicle="planar", initial_pose=start) as boat:
            radar = boat.add_range_bearing(range_sigma=0.1, bearing_sigma=0.01)
            self.assertEqual(set(boat.update(radar, [3, 4, 9], self.seen(start))["result"]), {cairn.Result.NEW})
            for landmark in boat.map.landmarks():
                np.testing.assert_allclose(landmark["position"], [*self.PLACES[int(landmark["id"])], 0], atol=1e-9)
                self.assertTrue((landmark["covariance"][2] == 0).all())
            boat.predict_twist(1.0, (1.0, 0, 0.7), (0.1, 0, 0.2))  # components out of the plane are ignored
            there = cairn.Pose(*boat.pose()[:2])
            self.assertEqual(there.position[2], 0.0)
            matches = boat.update(radar, [3, 9], self.seen(there, (3, 9)), np.tile(np.diag([0.04, 1e-4]), (2, 1, 1)))
            self.assertEqual(set(matches["result"]), {cairn.Result.MATCHED})
            covariance = boat.pose()[2]
            self.assertTrue((covariance[2:5] == 0).all())
            self.assertLess(boat.pose_nees(there), 1.0)
            self.assertEqual(boat.update_heading(0.7, 0.01)["result"], cairn.Result.MATCHED)
            self.assertEqual(boat.update_position(there.position, np.eye(3))["result"], cairn.Result.MATCHED)

    def test_sensors_of_the_other_kind_are_refused(self):
        with cairn.Filter(vehicle="planar") as boat, cairn.Filter() as rover:
            with self.assertRaisesRegex(cairn.CairnError, "ARGUMENT.*planar"):
                boat.add_stereo_head()
            with self.assertRaisesRegex(cairn.CairnError, "ARGUMENT"):
                rover.add_range_bearing()
            with self.assertRaisesRegex(cairn.CairnError, "range_sigma"):
                boat.add_range_bearing(range_sigma=0.0)

    def test_a_custom_sensor_of_two_values(self):
        def predict(pose, landmark):
            heading = 2 * np.arctan2(pose.quaternion[3], pose.quaternion[0])
            c, s = np.cos(heading), np.sin(heading)
            turn, off = np.array([[c, s], [-s, c]]), landmark[:2] - pose.position[:2]
            jacobian_pose, jacobian_landmark = np.zeros((2, 6)), np.zeros((2, 3))
            jacobian_pose[:, :2], jacobian_landmark[:, :2] = -turn, turn
            jacobian_pose[:, 5] = turn @ np.array([off[1], -off[0]])
            return turn @ off, jacobian_pose, jacobian_landmark

        with cairn.Filter(vehicle="planar") as boat:
            points = boat.add_cartesian(sigma=(0.1, 0.1, 0.1))
            own = boat.add_custom(predict, rows=2, sigma=(0.1, 0.1, 1.0), relative=1)
            z = [self.PLACES[3]]
            self.assertEqual(boat.update(points, [3], z)["result"][0], cairn.Result.NEW)
            before = boat.map.landmark(3)["covariance"][0, 0]
            self.assertEqual(boat.update(own, [3], z)["result"][0], cairn.Result.MATCHED)
            self.assertAlmostEqual(boat.map.landmark(3)["covariance"][0, 0], before / 2, places=12)


if __name__ == "__main__":
    unittest.main()
