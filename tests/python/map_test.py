# SPDX-License-Identifier: BSD-3-Clause
"""Queries of maps, poses, and simulated worlds."""
import unittest

import support
import cairn
import numpy as np
from support import LANDMARKS, seen


class MapTest(unittest.TestCase):
    def setUp(self):
        self.filter = cairn.Filter(max_landmarks=20)
        self.filter.update(self.filter.add_cartesian(sigma=[0.1, 0.2, 0.3]), list(LANDMARKS), seen())
        self.map = self.filter.map

    def test_all(self):
        known = self.map.landmarks()
        self.assertEqual((self.map.size, len(self.map)), (4, 4))
        self.assertEqual(known["id"].tolist(), sorted(LANDMARKS))
        for landmark in known:
            np.testing.assert_allclose(landmark["position"], LANDMARKS[int(landmark["id"])], atol=1e-12)
            np.testing.assert_allclose(landmark["covariance"], np.diag([0.01, 0.04, 0.09]), atol=1e-12)
        self.assertEqual(known["observations"].tolist(), [1] * 4)
        self.assertEqual(self.map.landmark(9).tobytes(), known[known["id"] == 9][0].tobytes())

    def test_searches(self):
        point = np.array([5.0, 1.0, 0.0])
        distance = {i: np.linalg.norm(np.subtract(p, point)) for i, p in LANDMARKS.items()}
        nearest = sorted(distance, key=distance.get)
        for count in range(6):
            self.assertEqual(self.map.nearest(point, count)["id"].tolist(), nearest[:count])
        for radius in (0.0, 2.0, 4.5, 6.0, 100.0):
            self.assertEqual(self.map.within(point, radius)["id"].tolist(), [i for i in nearest if distance[i] <= radius])
        self.assertEqual(self.map.in_box([3, 0, -1], [7, 9, 1])["id"].tolist(), [7, 9])

    def test_joint_covariance(self):
        self.assertEqual(self.map.joint_covariance([]).shape, (0, 0))
        joint = self.map.joint_covariance([12, 7])
        self.assertEqual(joint.tobytes(), self.filter.joint_covariance([12, 7])[6:, 6:].tobytes())
        np.testing.assert_allclose(np.diag(joint), [0.01, 0.04, 0.09] * 2, atol=1e-12)

    def test_bad_input(self):
        for call, word in ((lambda: self.map.landmark(3), "NOT_FOUND"), (lambda: self.map.within([0, 0, 0], -1), "ARGUMENT"),
                           (lambda: self.map.joint_covariance([7, 7]), "ARGUMENT"),
                           (lambda: self.map.in_box([1, 1, 1], [0, 0, 0]), "ARGUMENT")):
            with self.assertRaisesRegex(cairn.CairnError, word):
                call()
        with self.assertRaisesRegex(ValueError, "centre: shape 3"):
            self.map.within([0, 0], 1.0)
        with self.assertRaises(OverflowError):
            self.map.nearest([0, 0, 0], -1)

    def test_an_empty_map(self):
        with cairn.Filter() as empty:
            self.assertEqual(len(empty.map.landmarks()), 0)
            self.assertEqual(len(empty.map.nearest([0, 0, 0], 3)), 0)


class CopyTest(unittest.TestCase):
    """Two vehicles observe the same landmarks, each from the origin of its own frame."""
    T = cairn.Pose(np.array([4.0, -2.0, 1.0]), cairn.quaternion_from_euler(0.05, -0.1, 0.7))  # the second frame in the first

    def setUp(self):
        random = support.random(5)
        self.field = np.column_stack([random.uniform(-20, 20, 30), random.uniform(-20, 20, 30), random.uniform(-3, 3, 30)])
        self.first = self.vehicle(self.field[:20], np.arange(20), random)
        back = cairn.pose_inverse(self.T)
        there = np.array([cairn.pose_compose(back, (point, [1, 0, 0, 0])).position for point in self.field])
        self.second = self.vehicle(there[8:], np.arange(8, 30), random)
        self.random, self.there = random, there

    def vehicle(self, points, ids, random):
        vehicle = cairn.Filter(max_landmarks=40, max_observations=40)
        vehicle.update(vehicle.add_cartesian(sigma=[0.02] * 3), ids, points + 0.02 * random.randn(len(points), 3))
        self.addCleanup(vehicle.close)
        return vehicle

    def test_a_copy_stands_on_its_own(self):
        copy = self.first.map.copy()
        before = copy.landmarks().tobytes()
        self.assertEqual(before, self.first.map.landmarks().tobytes())
        self.assertEqual(copy.kind, "dense")
        self.first.remove_landmark(3)
        self.assertEqual(len(self.first.map), 19)
        self.first.close()
        self.assertEqual(copy.landmarks().tobytes(), before)
        again = copy.copy()
        copy.close()
        self.assertEqual(again.landmarks().tobytes(), before)
        with self.assertRaisesRegex(cairn.CairnError, "STATE"):
            copy.landmarks()
        again.close()

    def test_merge_by_id(self):
        both = self.first.map.copy()
        self.assertEqual(len(both.merged_ids()), 0)
        report = both.merge(self.second.map)
        self.assertEqual((report["common"], report["added"], report["rows"]), (12, 10, 30))
        self.assertEqual(report["broken_id"], cairn.ID_NONE)
        self.assertLess(report["distance"], report["threshold"])
        known = both.landmarks()
        self.assertEqual(known["id"].tolist(), list(range(30)))
        np.testing.assert_allclose(known["position"], self.field, atol=0.15)
        error = cairn.pose_error(self.T, report["T_map_other"])
        self.assertLess(error @ np.linalg.solve(report["covariance"], error), 30)
        merged = both.merged_ids()
        self.assertEqual(merged["id"].tolist(), list(range(8, 30)))
        self.assertEqual(merged["common"].tolist(), [1] * 12 + [0] * 10)

    def test_merge_by_geometry_and_with_a_transform(self):
        renamed = self.vehicle(self.there[8:], np.arange(22) + 15, self.random)
        both = self.first.map.copy()
        report = both.merge(renamed.map, by="geometry", max_tilt=0.5)
        self.assertEqual((report["common"], report["added"]), (12, 10))
        merged = both.merged_ids()
        self.assertEqual(merged["id"][:12].tolist(), list(range(8, 20)))
        self.assertEqual(merged["id"][12:].tolist(), list(range(27, 37)))
        exact = self.first.map.copy()
        report = exact.merge(self.second.map, transform=self.T)
        self.assertEqual(report["rows"], 36)
        np.testing.assert_array_equal(report["covariance"], np.zeros((6, 6)))
        loose = self.first.map.copy().merge(self.second.map, transform=self.T, covariance=np.eye(6))
        self.assertTrue((np.diag(loose["covariance"]) > 0).all())

    def test_refusals_change_nothing(self):
        both = self.first.map.copy()
        before = both.landmarks().tobytes(), both.joint_covariance(range(20)).tobytes()
        wrong = self.vehicle(self.there[8:][::-1], np.arange(8, 30), self.random)
        with self.assertRaisesRegex(cairn.CairnError, "NUMERICAL.*contradicts") as caught:
            both.merge(wrong.map)
        self.assertEqual(caught.exception.report["common"], 12)
        self.assertIn(caught.exception.report["broken_id"], range(8, 20))
        for call, word in ((lambda: both.merge(both), "ARGUMENT.*other"), (lambda: both.merge(self.first.map), "STATE.*twice"),
                           (lambda: self.first.map.merge(self.second.map), "STATE.*copy"),
                           (lambda: both.merge(self.second.map, max_landmarks=29), "CAPACITY"),
                           (lambda: both.merge(self.second.map, max_tilt=-1), "ARGUMENT.*max_tilt")):
            with self.assertRaisesRegex(cairn.CairnError, word):
                call()
        for call in (lambda: both.merge(self.second), lambda: both.merge(self.second.map, covariance=np.eye(6)),
                     lambda: both.merge(self.second.map, tilt=1)):
            with self.assertRaises(TypeError):
                call()
        with self.assertRaises(ValueError):
            both.merge(self.second.map, by="name")
        self.assertEqual(before, (both.landmarks().tobytes(), both.joint_covariance(range(20)).tobytes()))


class PoseTest(unittest.TestCase):
    def test_compose_and_error(self):
        a = cairn.Pose(np.array([1.0, 2, 3]), cairn.quaternion_from_euler(0.1, -0.2, 0.3))
        back = cairn.pose_compose(a, cairn.pose_inverse(a))
        np.testing.assert_allclose(back.position, 0, atol=1e-12)
        np.testing.assert_allclose(back.quaternion, [1, 0, 0, 0], atol=1e-12)
        np.testing.assert_allclose(cairn.quaternion_to_euler(a.quaternion), [0.1, -0.2, 0.3])
        moved = (a.position + [0.5, 0, 0], a.quaternion)
        np.testing.assert_allclose(cairn.pose_error(moved, a), [0.5, 0, 0, 0, 0, 0], atol=1e-12)
        with self.assertRaisesRegex(cairn.CairnError, "ARGUMENT"):
            cairn.pose_inverse(([0, 0, 0], [0, 0, 0, 0]))
        with self.assertRaisesRegex(ValueError, "T_a_b: must be a pose"):
            cairn.pose_inverse(3)


class WorldTest(unittest.TestCase):
    def drive(self, world, **options):
        one = cairn.Filter(max_landmarks=250, max_observations=world.most_observations, initial_pose=world.pose(0.0),
                           **options)
        head = one.add_stereo_head(**world.head())
        for step in world:
            one.set_twist_noise(velocity_sigma=step.velocity_sigma, rate_sigma=step.rate_sigma)
            for motion in step.motions:
                one.predict_twist(motion["dt"], motion["velocity"], motion["rate"])
            one.point_head(head, step.pan, step.stick)
            one.update(head, step.observations)
        return one, step

    def test_a_drive(self):
        with cairn.World(seed=3) as world:
            one, last = self.drive(world)
            self.assertEqual(last.number, len(world) - 1)
            error, sigma = cairn.pose_error(last.truth, one.pose()[:2]), np.sqrt(np.diag(one.pose()[2]))
            self.assertTrue((np.abs(error) < 4 * sigma).all(), error / sigma)
            self.assertLess(np.linalg.norm(error[:3]), 1.0)
            true = world.landmarks()
            for landmark in one.map.landmarks():
                off = true[int(landmark["id"])] - landmark["position"]
                self.assertLess(off @ np.linalg.solve(landmark["covariance"], off), 25.0)
                self.assertEqual(world.landmark(landmark["id"]).tolist(), true[int(landmark["id"])].tolist())
            again, _ = self.drive(world)
            self.assertEqual(again.pose()[2].tobytes(), one.pose()[2].tobytes())

    def test_steps(self):
        with cairn.World(preset="row1", seed=5, frame_period=4.0) as world:
            steps = list(world)
            self.assertEqual(len(steps), len(world))
            self.assertEqual(len(steps[0].motions), 0)
            self.assertEqual(len(steps[1].motions), 20)
            self.assertAlmostEqual(steps[1].motions["dt"].sum(), 4.0)
            self.assertEqual(steps[3].observations["z"].shape, (len(steps[3].observations), 3))
            np.testing.assert_allclose(steps[2].truth.position, world.pose(steps[2].time).position, atol=1e-6)
            with self.assertRaises(StopIteration):
                world.next()
            world.rewind()
            first = world.next()
            self.assertEqual((first.number, first.time), (0, 0.0))

    def test_ground(self):
        world = cairn.World(seed=2)
        self.assertAlmostEqual(world.height(100.0, 20.0), -0.3174, places=6)
        grid = world.height(*np.meshgrid([0.0, 10.0], [0.0, 5.0, 9.0]))
        self.assertEqual(grid.shape, (3, 2))
        self.assertEqual(grid[1, 1], world.height(10.0, 5.0))
        contacts = world.contacts(1.0)
        np.testing.assert_allclose(contacts[:, 2], world.height(contacts[:, 0], contacts[:, 1]), atol=1e-6)
        lower, upper = world.extent()
        true = world.landmarks()
        self.assertTrue((true[:, :2] >= lower).all() and (true[:, :2] <= upper).all())

    def test_bad_input(self):
        with self.assertRaisesRegex(cairn.CairnError, "ARGUMENT.*landmarks"):
            cairn.World(landmarks=0)
        with self.assertRaisesRegex(TypeError, "no option 'hills'"):
            cairn.World(hills=3)
        with self.assertRaisesRegex(ValueError, "preset: must be one of 'paper'"):
            cairn.World("row9")
        world = cairn.World()
        with self.assertRaisesRegex(cairn.CairnError, "NOT_FOUND"):
            world.landmark(10**6)
        with self.assertRaisesRegex(cairn.CairnError, "ARGUMENT"):
            world.pose(-1.0)
        world.close()
        for call in (world.next, lambda: len(world), world.landmarks, lambda: world.height(0, 0)):
            with self.assertRaisesRegex(cairn.CairnError, "the world is closed"):
                call()


if __name__ == "__main__":
    unittest.main()
