# SPDX-License-Identifier: BSD-3-Clause
"""Young landmarks whose first observation was a gross error (docs/update.md, "A landmark that was placed wrongly")."""
import unittest

import support
import cairn
import numpy as np

PLANAR = np.array([[5, 0], [4, 3], [0, 5], [-4, 3], [-5, -1], [2, -5], [6, 5.0]])
SPATIAL = np.column_stack([PLANAR, [1.0, -1.0, 0.5, 2.0, -2.0, 0.0, 0.7]])
OLD, YOUNG = range(6), 6  # by number, which is the id
GROSS = np.array([3.0, -2.0, 1.0])
STILL = ((0, 0, 0), (1, 0, 0, 0))


class Drive:
    """A vehicle that drifts a little, among six landmarks and a seventh that comes later."""

    def __init__(self, points=PLANAR, frames=5, step=0.01, **options):
        self.points, self.random, self.step = points.copy(), support.random(1), step
        self.size = points.shape[1]
        options.setdefault("max_landmarks", 7)
        self.vehicle = cairn.Filter(vehicle="planar" if self.size == 2 else "spatial", max_observations=16, **options)
        self.sensor = self.vehicle.add_cartesian(sigma=[0.05] * 3)
        turn = [0.0, 0.0] if self.size == 2 else [1e-6, 1e-6]
        self.motion = np.diag([step ** 2] * self.size + [0.0] * (3 - self.size) + turn + [1e-6])
        self.place = np.zeros(self.size)
        for _ in range(frames):
            self.frame(OLD)

    def frame(self, which, errors=None, slip=0.0):
        """The results of a frame by id; `errors` are those of single observations."""
        which = list(which)
        self.place = self.place + self.random.normal(0, min(self.step, 0.01), self.size)
        self.place[0] += slip
        self.vehicle.predict_increment(STILL, self.motion)
        z = self.points[which] - self.place + self.random.normal(0, 0.05, (len(which), self.size))
        for id, error in (errors or {}).items():
            z[which.index(id)] += np.asarray(error)[:self.size]
        self.matches = {int(id): match for id, match in zip(which, self.vehicle.update(self.sensor, which, z))}
        return {id: int(match["result"]) for id, match in self.matches.items()}

    def young(self, error=None):
        """The result of a frame with all landmarks for the young one."""
        results = self.frame(range(7), None if error is None else {YOUNG: error})
        assert all(results[id] != cairn.Result.REJECTED for id in OLD), results
        return results[YOUNG]

    def placed_again(self):
        return self.vehicle.last_update()["placed_again"]

    def counts(self, id=YOUNG):
        return id in self.vehicle.local_map.landmarks()["id"]

    def error(self, id=YOUNG):
        found = self.vehicle.local_map.landmark(id)["position"][:self.size]
        return np.linalg.norm(found - self.points[id])


def all_kinds(test):
    def run(self):
        for points in (PLANAR, SPATIAL):
            for error in ("invariant", "standard"):
                for submap in (0, 30):
                    with self.subTest(size=points.shape[1], state_error=error, submap=submap):
                        test(self, lambda **more: Drive(points, state_error=error, submap_landmarks=submap, **more))
    return run


class PlacedAgainTest(unittest.TestCase):
    @all_kinds
    def test_two_observations_outvote_the_one_that_placed_it(self, drive):
        one = drive()
        self.assertEqual(one.young(GROSS), cairn.Result.NEW)
        self.assertTrue(one.counts())
        self.assertEqual(one.young(), cairn.Result.REJECTED)
        self.assertFalse(one.counts())  # one against one
        self.assertEqual(one.vehicle.last_update()["deferred"], 1)
        self.assertEqual((one.young(), one.placed_again()), (cairn.Result.NEW, 1))  # although the map is full
        match = one.matches[YOUNG]
        self.assertEqual((match["landmark"], match["reason"]), (YOUNG, 0))
        self.assertGreater(match["distance"], match["threshold"])
        self.assertGreater(match["threshold"], 0)
        self.assertTrue(one.counts())
        self.assertEqual(one.vehicle.last_update()["deferred"], 0)
        for _ in range(10):
            self.assertEqual((one.young(), one.placed_again()), (cairn.Result.MATCHED, 0))
        self.assertEqual(one.vehicle.local_map.landmark(YOUNG)["observations"], 11)
        self.assertLess(one.error(), 0.1)
        self.assertGreater(one.vehicle.audit(), 0)

    @all_kinds
    def test_the_third_observation_decides_for_the_first(self, drive):
        one = drive()
        self.assertEqual(one.young(), cairn.Result.NEW)
        self.assertEqual(one.young(GROSS), cairn.Result.REJECTED)
        self.assertFalse(one.counts())
        self.assertEqual((one.young(), one.placed_again()), (cairn.Result.MATCHED, 0))
        self.assertTrue(one.counts())
        self.assertLess(one.error(), 0.15)

    def test_observations_that_all_differ_decide_nothing(self):
        one = Drive()
        self.assertEqual(one.young(GROSS), cairn.Result.NEW)
        for error in (-GROSS, 2 * GROSS, None):
            self.assertEqual(one.young(error), cairn.Result.REJECTED)
            self.assertFalse(one.counts())
        self.assertEqual((one.young(), one.placed_again()), (cairn.Result.NEW, 1))
        self.assertLess(one.error(), 0.2)

    def test_an_honest_observation_outside_of_the_gate_changes_nothing(self):
        one = Drive(step=1e-6)
        one.young()
        self.assertEqual(one.young([0.32, 0, 0]), cairn.Result.REJECTED)
        self.assertTrue(13.9 < one.matches[YOUNG]["distance"] < 27.0, one.matches[YOUNG])
        self.assertTrue(one.counts())

    def test_more_observations_need_more_to_outvote_them(self):
        one = Drive()
        for _ in range(4):
            one.young()
        one.points[YOUNG] += GROSS[:2]
        results = [(one.young(), one.placed_again()) for _ in range(6)]
        self.assertEqual(results[:4], [(cairn.Result.REJECTED, 0)] * 4)
        self.assertEqual(results[4:], [(cairn.Result.NEW, 1), (cairn.Result.MATCHED, 0)])

    def test_an_old_landmark_that_moved_stays(self):
        one = Drive()
        for _ in range(12):
            one.young()
        one.points[YOUNG] += GROSS[:2]
        for _ in range(30):
            self.assertEqual((one.young(), one.placed_again()), (cairn.Result.REJECTED, 0))
        self.assertTrue(one.counts())
        self.assertGreater(one.error(), 3.0)

    @all_kinds
    def test_not_after_a_slip(self, drive):
        """All landmarks contradict: the pose is wrong. They are too young to be witnesses."""
        one = drive(frames=3)
        one.frame(OLD, slip=2.0)
        for _ in range(12):
            self.assertEqual(set(one.frame(OLD).values()), {cairn.Result.REJECTED})
            self.assertEqual(one.placed_again(), 0)
        self.assertTrue(all(one.counts(id) for id in OLD))

    def test_not_while_witnesses_contradict(self):
        """Three witnesses and 3 to 5 against ten landmarks that were placed after the slip: 3 to 5 may be right."""
        points = np.vstack([PLANAR[:6], np.column_stack([np.arange(10) - 3.0, np.full(10, 7.0)])])
        one = Drive(points, max_landmarks=16, frames=3)
        young = range(6, 16)
        one.frame(range(3))  # 0 to 2 get old
        for _ in range(8):
            one.frame(range(3))
        one.frame(range(3), slip=2.0)
        one.frame(young)
        for _ in range(5):
            results = one.frame(range(16))
            self.assertEqual([results[id] for id in (3, 4, 5)], [cairn.Result.REJECTED] * 3)
            self.assertEqual(one.placed_again(), 0)

    def test_a_motion_that_is_hardly_known_decides_nothing(self):
        one = Drive(step=3.0)  # the landmarks say where the vehicle is, dead reckoning does not
        one.young(GROSS)
        for _ in range(6):
            self.assertEqual((one.young(), one.placed_again()), (cairn.Result.REJECTED, 0))

    def test_the_state_is_that_of_a_landmark_that_is_placed_for_the_first_time(self):
        """Also the correlation by the encoders of a head, whose error the frame has in common."""
        def run(removed):
            random = support.random(2)
            one = cairn.Filter(max_landmarks=9, max_observations=9)
            head = one.add_stereo_head(encoder_mode=1, range_sigma=0.1, azimuth_sigma=0.01, elevation_sigma=0.01,
                                       pan_sigma=0.02, stick_sigma=0.02)
            points = np.column_stack([[4, 5, 6, 7, 8, 5, 6, 7, 8.0], [3, 2, 1, 0, -1, -2, -3, 4, 5], np.arange(9) % 3])
            for k in range(12):
                one.predict_increment(STILL, np.diag([1e-4] * 3 + [1e-6] * 3))
                p = points + random.normal(0, 0.01, points.shape)
                if k == 9:
                    p[[2, 5]] += [4.0, 5.0, 1.0]
                which = [0, 1, 3, 4, 6, 7, 8] if k < 9 else range(9)
                if removed and k == 11:
                    one.remove_landmark(2)
                    one.remove_landmark(5)
                z = np.column_stack([np.linalg.norm(p, axis=1), np.arctan2(p[:, 1], p[:, 0]),
                                     np.arctan2(p[:, 2], np.hypot(p[:, 0], p[:, 1]))])
                one.update(head, list(which), z[list(which)])
            self.assertEqual((one.last_update()["placed"], one.last_update()["placed_again"]), (2, 0 if removed else 2))
            return one
        again, fresh = run(False), run(True)
        for id in range(9):
            np.testing.assert_allclose(again.map.landmark(id)["position"], fresh.map.landmark(id)["position"],
                                       rtol=1e-12)
        np.testing.assert_allclose(again.joint_covariance(range(9)), fresh.joint_covariance(range(9)), rtol=1e-9,
                                   atol=1e-15)


def both_joinings(test):
    def run(self):
        for join in ("dense", "sparse"):
            with self.subTest(join=join):
                # 8: a landmark that takes an id has a place of its own until the closing is complete.
                test(self, Drive(submap_landmarks=30, join=join, max_landmarks=8, gate_probability=0.999))
    return run


class ClosingTest(unittest.TestCase):

    def at(self, one):
        return one.vehicle.map.landmark(YOUNG)["position"][:2]

    @both_joinings
    def test_the_landmark_of_a_later_submap_takes_the_id(self, one):
        one.young(GROSS)
        one.vehicle.close_submap()
        self.assertGreater(np.linalg.norm(self.at(one) - one.points[YOUNG]), 3.0)
        for _ in range(3):
            one.young()
        one.vehicle.close_submap()
        self.assertLess(np.linalg.norm(self.at(one) - one.points[YOUNG]), 0.2)
        self.assertEqual(one.vehicle.map.landmark(YOUNG)["observations"], 3)
        self.assertEqual([int(id) for id in one.vehicle.map.within([6, 5, 0], 1.0)["id"]], [YOUNG])
        self.assertEqual(len(one.vehicle.map), 7)
        one.young()
        one.vehicle.close_submap()
        self.assertEqual(one.vehicle.last_closing()["landmarks_refused"], 0)
        self.assertEqual(one.vehicle.map.landmark(YOUNG)["observations"], 4)

    @both_joinings
    def test_one_against_one_leaves_neither(self, one):
        one.young(GROSS)
        one.vehicle.close_submap()
        one.young()
        one.vehicle.close_submap()
        self.assertEqual([int(id) for id in one.vehicle.map.landmarks()["id"]], list(OLD))
        one.young()
        one.vehicle.close_submap()
        self.assertLess(np.linalg.norm(self.at(one) - one.points[YOUNG]), 0.3)

    @both_joinings
    def test_an_old_landmark_of_the_map_keeps_its_id(self, one):
        for _ in range(12):
            one.young()
        before = one.points[YOUNG].copy()
        one.vehicle.close_submap()
        one.points[YOUNG] += GROSS[:2]
        for _ in range(20):
            one.young()
        one.vehicle.close_submap()
        self.assertEqual(one.vehicle.last_closing()["landmarks_refused"], 1)
        self.assertLess(np.linalg.norm(self.at(one) - before), 0.2)


class ManyGrossErrorsTest(unittest.TestCase):
    """While many observations are gross errors, one observation alone places no landmark."""

    def drive(self, points=PLANAR, **options):
        """Six landmarks of which two are gross in each frame; the seventh and more come later."""
        one = Drive(points, max_landmarks=60, **options)
        for k in range(8):
            one.frame(OLD, {k % 6: GROSS * (1 + k), (k + 1) % 6: -GROSS * (2 + k)})
        return one

    def test_a_new_landmark_counts_from_the_second_observation_that_agrees(self):
        for submap in (0, 30):
            one = self.drive(submap_landmarks=submap)
            self.assertEqual(one.frame(range(7))[YOUNG], cairn.Result.NEW)
            self.assertFalse(one.counts())
            self.assertEqual(one.vehicle.last_update()["deferred"], 1)
            self.assertEqual(one.frame(range(7))[YOUNG], cairn.Result.MATCHED)
            self.assertTrue(one.counts())
            self.assertLess(one.error(), 0.2)

    def test_a_gross_error_that_nothing_confirms_never_counts(self):
        for submap in (0, 30):
            one = self.drive(submap_landmarks=submap)
            one.frame(range(7), {YOUNG: GROSS})
            one.frame(OLD)
            self.assertFalse(one.counts())
            if submap == 0:
                continue
            one.vehicle.close_submap()
            self.assertEqual([int(id) for id in one.vehicle.map.landmarks()["id"]], list(OLD))
            self.assertEqual(one.frame(range(7))[YOUNG], cairn.Result.NEW)

    def test_a_submap_compares_its_only_observation_with_the_map(self):
        one = self.drive(submap_landmarks=30, join="dense")
        for _ in range(3):
            one.frame(range(7))
        one.vehicle.close_submap()
        seen = one.vehicle.map.landmark(YOUNG)["observations"]
        one.frame(range(7), {0: GROSS, 1: -GROSS})  # all are new in this submap
        one.frame(OLD)
        one.vehicle.close_submap()
        self.assertEqual(one.vehicle.map.landmark(YOUNG)["observations"], seen + 1)

    def test_a_single_gross_error_is_not_many(self):
        one = Drive(max_landmarks=30)
        one.frame(OLD, {0: GROSS})
        one.young()
        self.assertTrue(one.counts())

    def test_it_ends_with_the_gross_errors(self):
        one = self.drive()
        for _ in range(300):
            one.frame(OLD)
        one.young()
        self.assertTrue(one.counts())

    def test_a_full_submap_of_which_nothing_counts_makes_room(self):
        points = np.vstack([PLANAR, np.column_stack([np.arange(42) * 0.5 - 10, np.full(42, 8.0)])])
        one = self.drive(points, submap_landmarks=12)  # room for 28
        one.vehicle.close_submap()
        for start, removed in ((7, 0), (21, 28)):  # each is seen once
            self.assertEqual(set(one.frame(range(start, start + 14)).values()), {cairn.Result.NEW})
            self.assertEqual(one.vehicle.last_update()["removed"], removed)
        self.assertEqual(set(one.frame(range(35, 49)).values()), {cairn.Result.NEW})



class FirstFramesTest(unittest.TestCase):
    def test_a_first_landmark_that_a_gross_error_placed_is_placed_again(self):
        """Nothing else is known: no observation can agree with the estimate."""
        one = Drive(frames=0)
        one.frame([YOUNG], {YOUNG: GROSS})
        one.frame([YOUNG])
        self.assertEqual((one.frame([YOUNG])[YOUNG], one.placed_again()), (cairn.Result.NEW, 1))
        self.assertLess(one.error(), 0.2)


if __name__ == "__main__":
    unittest.main()
