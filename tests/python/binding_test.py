# SPDX-License-Identifier: BSD-3-Clause
"""What the Python layer adds to the C interface: ids of 64 bits, frames without copies, callbacks and their lifetimes,
threads, and the functions of the interface that other tests do not call."""
import gc
import re
import sys
import threading
import unittest
import weakref

import support
import cairn
import numpy as np
from support import seen

IDENTITY = (np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0]))


def filled(**options):
    """A filter that knows four landmarks, and its sensor of points."""
    made = cairn.Filter(max_landmarks=20, **options)
    sensor = made.add_cartesian(sigma=[0.1, 0.1, 0.2])
    made.update(sensor, list(support.LANDMARKS), seen())
    return made, sensor


def offset(pose, landmark):
    """Observes the point in the axes of the map, from a vehicle that does not rotate."""
    return landmark - pose.position, np.hstack([-np.eye(3), np.zeros((3, 3))]), np.eye(3)


def place(pose, z):
    return pose.position + z, np.hstack([np.eye(3), np.zeros((3, 3))]), np.eye(3)


class FramesTest(unittest.TestCase):
    def test_ids_beyond_two_to_the_53(self):
        ids = [2**53 + 1, 2**63 + 3, 2**64 - 2, 0]
        for given in (ids, np.array(ids, np.uint64), (number for number in ids), [np.uint64(number) for number in ids]):
            one = cairn.Filter(max_landmarks=20)
            sensor = one.add_cartesian()
            self.assertEqual(one.update(sensor, given, seen())["landmark"].tolist(), ids)
            self.assertEqual(one.map.landmark(2**53 + 1)["id"], 2**53 + 1)
            self.assertEqual(one.map.landmarks()["id"].tolist(), sorted(ids))
            with self.assertRaisesRegex(cairn.CairnError, f"NOT_FOUND.*{2**53}"):
                one.map.landmark(2**53)
        with self.assertRaisesRegex(ValueError, "id: is not in 0 to"):
            one.map.landmark(2**64)
        with self.assertRaisesRegex(TypeError, "id: must be a whole number"):
            one.map.landmark(2.0**53)
        with self.assertRaisesRegex(TypeError, "ids: must be whole numbers"):
            one.update(sensor, np.array([2.0**53]), [[1, 2, 3]])

    def test_all_forms_of_a_frame_are_the_same(self):
        ids, z = list(support.LANDMARKS), seen()
        forms = [(cairn.observations(ids, z),), (np.array(ids), z), (np.array(ids, np.uint64), z), (ids, z.tolist()),
                 (np.array(ids, np.int32), z.astype(np.float32)), (tuple(ids), [tuple(row) for row in z]),
                 (np.array(ids + ids)[:4], np.asfortranarray(z)), (np.repeat(ids, 2)[::2], np.repeat(z, 2, axis=0)[::2]),
                 (iter(ids), list(z)), (np.repeat(cairn.observations(ids, z), 2)[::2],),
                 (ids, z, np.tile(np.diag([0.01, 0.01, 0.04]), (4, 1, 1)))]
        results = set()
        for form in forms:
            one, sensor = filled()
            results.add((one.update(sensor, *form).tobytes(), one.pose()[2].tobytes(), one.map.landmarks().tobytes()))
        self.assertEqual(len(results), 1)

    def test_a_frame_goes_in_without_a_copy(self):
        frame = cairn.observations([1, 2], [[1, 2, 3], [4, 5, 6]])
        self.assertIs(frame.dtype, cairn.OBSERVATION)
        self.assertTrue(np.shares_memory(cairn.observations(frame), frame))
        frame["z"][0, 0] = np.nan
        one, sensor = filled()
        with self.assertRaisesRegex(cairn.CairnError, r"observations\[0\]"):
            one.update(sensor, frame)

    def test_wrong_frames(self):
        one, sensor = filled()
        before = one.pose()[2].tobytes(), one.map.landmarks().tobytes()
        for error, arguments in ((TypeError, (np.zeros(3),)), (TypeError, (np.zeros(2, cairn.MATCH),)),
                                 (TypeError, (np.zeros((2, 2), cairn.OBSERVATION),)), (ValueError, ([1, 2], seen())),
                                 (ValueError, (np.array(7), seen([7]))), (ValueError, ([7], [[1, 2], [3, 4]])),
                                 (TypeError, ([7], [["1", "2", object()]])), (TypeError, ([7], None)),
                                 (ValueError, ([7], [[1, 2, 3, 4]])), (ValueError, ([7], [[]])), (TypeError, (7, seen([7]))),
                                 (ValueError, ([7], [1, 2, 3])), (OverflowError, ([7], seen([7])))):
            number = 2**31 if error is OverflowError else sensor
            with self.assertRaises(error, msg=repr(arguments)):
                one.update(number, *arguments)
        with self.assertRaises(TypeError):
            one.update("camera", [7], seen([7]))
        self.assertEqual(before, (one.pose()[2].tobytes(), one.map.landmarks().tobytes()))
        self.assertEqual(len(one.update(sensor, [], [])), 0)


class CallbacksTest(unittest.TestCase):
    def test_a_filter_keeps_its_functions_and_frees_them(self):
        for end in (lambda one: one.close(), lambda one: None):  # closed, or forgotten
            class Model:
                def predict(self, pose, landmark):
                    return offset(pose, landmark)

                def log(self, line):
                    pass

            model = Model()
            alive = weakref.ref(model)
            one = cairn.Filter()
            sensor = one.add_custom(model.predict, place)
            one.set_log(model.log)
            del model
            gc.collect()
            self.assertIsNotNone(alive())
            self.assertEqual(one.update(sensor, [1], [[1, 2, 3]])["result"], [cairn.Result.NEW])
            end(one)
            del one
            gc.collect()
            self.assertIsNone(alive())

    def test_a_refused_sensor_frees_its_functions(self):
        def predict(pose, landmark):
            return None

        alive = weakref.ref(predict)
        one = cairn.Filter(max_sensors=1)
        one.add_cartesian()
        with self.assertRaisesRegex(cairn.CairnError, "CAPACITY"):
            one.add_custom(predict)
        del predict
        gc.collect()
        self.assertIsNone(alive())

    def test_place_raises(self):
        def broken(pose, z):
            raise LookupError("no place")

        one, sensor = filled()
        custom = one.add_custom(offset, broken)
        before = one.pose()[2].tobytes(), one.map.landmarks().tobytes()
        with self.assertRaisesRegex(LookupError, "no place"):
            one.update(custom, [7, 99], [[6, 2, 0.5], [1, 1, 1]])
        self.assertEqual(before, (one.pose()[2].tobytes(), one.map.landmarks().tobytes()))
        self.assertEqual(one.update(sensor, [7], seen([7]))["result"], [cairn.Result.MATCHED])

    def test_an_exception_of_the_log_is_reported_and_the_call_succeeds(self):
        def log(line):
            raise RuntimeError("the disk is full")

        told, hook = [], sys.unraisablehook
        sys.unraisablehook = told.append
        try:
            one, sensor = filled(gate_probability=1.0)
            one.set_log(log)
            one.update(sensor, list(support.LANDMARKS),
                       seen() + [[5.0, 0, 0], [-5.0, 0, 0], [0, 5.0, 0], [0, -5.0, 0]])
        finally:
            sys.unraisablehook = hook
        self.assertGreater(len(told), 0)
        self.assertEqual((told[0].exc_type, str(told[0].exc_value)), (RuntimeError, "the disk is full"))

    def test_check_custom(self):
        landmark = [3.0, 4.0, 1.0]
        self.assertLess(cairn.check_custom(offset, place, IDENTITY, landmark), 1e-6)
        wrong = cairn.check_custom(lambda pose, l: (l - pose.position, np.zeros((3, 6)), np.eye(3)), None, IDENTITY, landmark)
        self.assertAlmostEqual(wrong, 1.0, places=5)
        with self.assertRaisesRegex(cairn.CairnError, "ARGUMENT"):
            cairn.check_custom(lambda pose, l: None, None, IDENTITY, landmark)
        with self.assertRaises(ZeroDivisionError):
            cairn.check_custom(lambda pose, l: 1 / 0, None, IDENTITY, landmark)


class ThreadsTest(unittest.TestCase):
    def test_each_thread_gets_its_own_message(self):
        calls = [lambda number: cairn.Filter(max_sensors=1000 + number), lambda number: cairn.World(landmarks=0, seed=number),
                 lambda number: cairn.Filter(max_landmarks=10).map.landmark(number),
                 lambda number: cairn.Filter(max_landmarks=10).predict_wheels(-1.0 - number, 1, 1)]
        words = [lambda number: f"max_sensors.*{1000 + number}", lambda number: "options.landmarks",
                 lambda number: f"{number}", lambda number: f"dt must be > 0, and is -{number + 1}"]
        wrong = []

        def fail(number):
            for i in range(100):
                try:
                    calls[(number + i) % 4](number)
                except cairn.CairnError as error:
                    if not re.search(words[(number + i) % 4](number), error.message):
                        wrong.append((number, error.message))

        threads = [threading.Thread(target=fail, args=(number,)) for number in range(16)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_a_filter_is_closed_while_threads_use_it(self):
        one, sensor = filled()
        refused = []

        def work():
            try:
                while True:
                    one.update(sensor, list(support.LANDMARKS), seen())
            except cairn.CairnError as error:
                refused.append(error.status)

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        one.close()
        for thread in threads:
            thread.join()
        self.assertEqual(refused, [cairn.Status.ERROR_STATE] * 4)


class FunctionsTest(unittest.TestCase):
    def test_landmarks_are_merged_and_split(self):
        one, sensor = filled(initial_covariance=1e-4 * np.eye(6))
        one.update(sensor, [50], seen([7]) + 0.01)
        match = one.merge_landmarks(7, 50)
        self.assertEqual((match["result"], match["landmark"]), (cairn.Result.MATCHED, 7))
        self.assertEqual(one.map.landmark(7)["observations"], 2)
        self.assertEqual(one.map.landmarks()["id"].tolist(), [7, 8, 9, 12])
        one.split_landmark(7, 51, 0.25 * np.eye(3))
        fresh = one.map.landmark(51)
        np.testing.assert_array_equal(fresh["position"], one.map.landmark(7)["position"])
        np.testing.assert_allclose(fresh["covariance"] - one.map.landmark(7)["covariance"], 0.25 * np.eye(3), atol=1e-12)
        with self.assertRaisesRegex(cairn.CairnError, "NOT_FOUND"):
            one.merge_landmarks(7, 99)
        with self.assertRaisesRegex(ValueError, "covariance: shape 3 x 3"):
            one.split_landmark(7, 52, np.eye(2))

    def test_view(self):
        one = cairn.Filter(max_landmarks=20, missed_frames=2)
        sensor = one.add_cartesian(sigma=[0.1, 0.1, 0.2])
        one.set_view(sensor, [-20, -20, -20], [20, 20, np.inf])
        one.update(sensor, list(support.LANDMARKS), seen())
        for _ in range(3):
            one.update(sensor, [7, 8, 9], seen([7, 8, 9]))
        self.assertEqual(one.map.landmarks()["id"].tolist(), [7, 8, 9])
        with self.assertRaisesRegex(cairn.CairnError, "ARGUMENT"):
            one.set_view(sensor, [1, 1, 1], [0, 0, 0])

    def test_poses(self):
        quarter = cairn.quaternion_exp([0, 0, np.pi / 2])
        np.testing.assert_allclose(quarter, cairn.quaternion_from_euler(0, 0, np.pi / 2), atol=1e-15)
        np.testing.assert_allclose(cairn.quaternion_log(quarter), [0, 0, np.pi / 2])
        np.testing.assert_allclose(cairn.pose_apply(([1, 0, 0], quarter), [2, 0, 0]), [1, 2, 0], atol=1e-15)
        for pose in (cairn.pose_identity(), cairn.Pose.identity()):
            np.testing.assert_array_equal(pose.position, IDENTITY[0])
            np.testing.assert_array_equal(pose.quaternion, IDENTITY[1])
        with self.assertRaisesRegex(ValueError, "T_a_b.quaternion: shape 4"):
            cairn.pose_apply(([1, 0, 0], [1, 0, 0]), [2, 0, 0])

    def test_constants_keep_their_names_of_version_0_1(self):
        for old, new in ((cairn.REJECTED, cairn.Result.REJECTED), (cairn.ERROR_STATE, cairn.Status.ERROR_STATE),
                         (cairn.LOSS_CAUCHY, cairn.Loss.CAUCHY), (cairn.TEAM_JOINT, cairn.TeamMode.JOINT),
                         (cairn.NOISE_APPLIED, cairn.NoiseLearning.APPLIED), (cairn.DOUBT_BIAS, cairn.Doubts.BIAS)):
            self.assertIs(old, new)
        with self.assertRaises(AttributeError):
            cairn.NOTHING

    def test_words(self):
        self.assertEqual(cairn.verdict_text(cairn.Verdict.LOST), "lost")
        self.assertEqual(cairn.verdict_text(99), "unknown")
        self.assertEqual(cairn.doubt_text(cairn.Doubts.LANDMARKS), "single landmarks contradict the rest")
        self.assertEqual(cairn.status_name(cairn.Status.ERROR_STATE), "CAIRN_ERROR_STATE")
        self.assertEqual(cairn.status_name(5), "unknown status")

    def test_presets_and_simulated_steps(self):
        options, submap_landmarks = cairn.world_preset("row3", seed=7)
        self.assertEqual((options["seed"], options["terrain"], submap_landmarks), (7, cairn.Terrain.WAVES, 20))
        world = cairn.World(**options)
        self.assertEqual(len(world.motions()), 0)
        world.next()
        step = world.next()
        np.testing.assert_array_equal(world.motions(), step.motions)
        np.testing.assert_array_equal(world.observations(), step.observations)
        fleet = cairn.Fleet(seed=3, features=6)
        boat = fleet.next().vehicles[0]
        self.assertEqual(fleet.seen_features(1)["id"].tolist(), boat.features["id"].tolist())
        self.assertEqual(fleet.vehicles()["x"][0], boat.truth.position[0])
        with self.assertRaisesRegex(cairn.CairnError, "NOT_FOUND"):
            fleet.seen_vehicles(3)


if __name__ == "__main__":
    unittest.main()
