# SPDX-License-Identifier: BSD-3-Clause
"""The filter: its results equal those of the C interface to the bit, and bad input is refused."""
import copy
import gc
import os
import pickle
import subprocess
import sys
import threading
import unittest
import weakref

import support
import cairn
import numpy as np
from cairn import _library, ffi, lib
from support import seen

NULL = ffi.NULL
LEVEL = (np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0]))


def filled(**options):
    """A filter that knows four landmarks, and its sensor of points."""
    made = cairn.Filter(max_landmarks=20, **options)
    sensor = made.add_cartesian(sigma=[0.1, 0.1, 0.2])
    made.update(sensor, list(support.LANDMARKS), seen())
    return made, sensor


class ResultsTest(unittest.TestCase):
    def test_same_bits_as_the_c_interface(self):
        options = ffi.new("cairn_filter_options *")
        lib.cairn_filter_options_init(options, ffi.sizeof("cairn_filter_options"), NULL)
        options.max_landmarks, options.state_error, options.gate_probability = 30, cairn.StateError.STANDARD, 0.999
        for i in range(6):
            options.initial_covariance[7 * i] = 0.01
        raw = ffi.new("cairn_filter **")
        self.assertEqual(lib.cairn_filter_create(options, raw, NULL), 0)
        head = ffi.new("cairn_stereo_head *")
        lib.cairn_stereo_head_init(head, ffi.sizeof("cairn_stereo_head"), NULL)
        head.range_sigma = 0.2
        camera = ffi.new("int32_t *")
        lib.cairn_filter_add_stereo_head(raw[0], head, camera, NULL)

        with cairn.Filter(max_landmarks=30, state_error="standard", gate_probability=0.999,
                          initial_covariance=0.01 * np.eye(6)) as layer:
            own = layer.add_stereo_head(range_sigma=0.2)
            self.assertEqual(own, camera[0])
            draw = support.random(1)
            for _ in range(40):
                rates = draw.normal(1.0, 0.1, 2)
                layer.predict_wheels(0.2, *rates)
                self.assertEqual(lib.cairn_filter_predict_wheels(raw[0], 0.2, *rates, NULL), 0)
                z = np.column_stack([draw.normal(10, 0.2, 5), draw.normal(np.arange(5) / 9, 0.05), draw.normal(0, 0.05, 5)])
                frame = ffi.new("cairn_observation[5]")
                for i in range(5):
                    frame[i].id = 100 + i
                    frame[i].z = list(z[i])
                raw_matches = ffi.new("cairn_match[5]")
                self.assertEqual(lib.cairn_filter_update(raw[0], camera[0], frame, 5, raw_matches, NULL), 0)
                matches = layer.update(own, np.arange(100, 105), z)
                for name in ("landmark", "result", "reason", "distance", "threshold"):
                    self.assertEqual(matches[name].tolist(), [getattr(match, name) for match in raw_matches])
            pose, covariance = ffi.new("cairn_pose *"), ffi.new("double[36]")
            lib.cairn_filter_pose(raw[0], pose, covariance, NULL)
            position, quaternion, own_covariance = layer.pose()
            self.assertEqual(position.tolist(), list(pose.position))
            self.assertEqual(quaternion.tolist(), list(pose.quaternion))
            self.assertEqual(own_covariance.ravel().tolist(), list(covariance))
            report = ffi.new("cairn_update_report *")
            report.struct_size = ffi.sizeof("cairn_update_report")
            lib.cairn_filter_last_update(raw[0], report, NULL)
            self.assertEqual(layer.last_update(), {name: getattr(report, name) for name in (
                "matched", "placed", "rejected", "rows", "iterations", "nis", "nis_lower", "nis_upper",
                "association_nodes", "association_exhausted", "association_seconds", "deferred", "removed",
                "widened_position", "widened_attitude", "placed_again")})
        lib.cairn_filter_destroy(raw[0])

    @unittest.skipUnless(os.environ.get("CAIRN_ROVER"), "the C program of the same example was not built by GCC")
    def test_the_example_prints_what_its_c_twin_prints(self):
        example = os.path.join(support.ROOT, "bindings", "python", "examples", "rover.py")
        in_python = subprocess.run([sys.executable, "-B", example], stdout=subprocess.PIPE, text=True, check=True).stdout
        in_c = subprocess.run([os.environ["CAIRN_ROVER"]], stdout=subprocess.PIPE, text=True, check=True).stdout
        self.assertEqual(in_python, in_c)
        self.assertGreater(len(in_c.splitlines()), 10)

    def test_the_best_build_is_loaded(self):
        folder = os.environ.get("CAIRN_LIBRARY") or _library.INSIDE
        two = os.path.isdir(os.path.join(folder, "glibc-hwcaps", "x86-64-v3")) and _library._has_v3()
        if two:
            self.assertEqual(ffi.string(lib.cairn_build()), b"x86-64-v3")
        self.assertIn(ffi.string(lib.cairn_build()), (b"x86-64", b"x86-64-v3", b"generic"))

    def test_predictions(self):
        with cairn.Filter() as one:
            one.set_twist_noise(velocity_sigma=[0.1, 0.2, 0.3], rate_sigma=[0.01] * 3)
            one.predict_twist(2.0, [0.5, 0, 0], [0, 0, 0])
            position, _, covariance = one.pose()
            np.testing.assert_allclose(position, [1.0, 0, 0])
            np.testing.assert_allclose(np.diag(covariance)[:3], [0.04, 0.16, 0.36], rtol=1e-3)
            quarter = cairn.quaternion_from_euler(0, 0, np.pi / 2)
            one.predict_increment(([0, 2.0, 0], quarter), np.zeros((6, 6)))
            np.testing.assert_allclose(one.pose()[0], [1.0, 2.0, 0], atol=1e-12)
            np.testing.assert_allclose(one.pose()[1], quarter, atol=1e-12)
            one.set_wheels(radius=0.5, track=2.0, yaw_sign="left_minus_right")
            one.predict_wheels(1.0, 2.0, 2.0)
            np.testing.assert_allclose(one.pose()[0], [1.0, 3.0, 0], atol=1e-12)

    def test_decisions_and_own_noise(self):
        one, sensor = filled()
        matches = one.update(sensor, [7, 8, 40], np.vstack([seen([7]), seen([8]) + 5.0, [[1.0, 1.0, 1.0]]]),
                             covariance=np.tile(0.01 * np.eye(3), (3, 1, 1)))
        self.assertEqual(matches["result"].tolist(), [cairn.Result.MATCHED, cairn.Result.REJECTED, cairn.Result.NEW])
        self.assertEqual(matches["landmark"].tolist(), [7, 8, 40])
        self.assertGreater(matches["distance"][1], matches["threshold"][1])
        np.testing.assert_allclose(one.map.landmark(40)["covariance"], 0.01 * np.eye(3), atol=1e-12)
        self.assertEqual(len(one.update(sensor, [], [])), 0)
        one.remove_landmark(40)
        # Landmark 8 was seen twice, and the two observations contradict each other: it does not count.
        self.assertEqual(one.map.landmarks()["id"].tolist(), [7, 9, 12])

    def test_absolute_and_linear(self):
        one = cairn.Filter(initial_covariance=np.eye(6) * 0.25)
        match = one.update_position([0.4, 0, 0], 1e-6 * np.eye(3), lever_arm=[0.1, 0, 0])
        self.assertEqual(match["result"], cairn.Result.MATCHED)
        np.testing.assert_allclose(one.pose()[0][0], 0.3, atol=1e-2)
        self.assertEqual(one.update_attitude([1, 0, 0, 0], 1e-4 * np.eye(3))["result"], cairn.Result.MATCHED)
        self.assertEqual(one.update_heading(0.0, 0.1)["result"], cairn.Result.MATCHED)
        before = one.pose()[2][2, 2]
        height = one.update_linear([0.0], [[1e-4]], jacobian_pose=[[0, 0, 1, 0, 0, 0]])
        self.assertEqual(height["result"], cairn.Result.MATCHED)
        self.assertEqual(height["landmark"], cairn.ID_NONE)
        self.assertLess(one.pose()[2][2, 2], before)
        two, _ = filled()
        joint = two.joint_covariance([9, 7])
        self.assertEqual(joint.shape, (12, 12))
        self.assertEqual(two.update_linear([0.01], [[0.01]], None, [9], [[0, 0, 1.0]])["landmark"], 9)
        self.assertLess(two.joint_covariance([9, 7])[8, 8], joint[8, 8])
        self.assertGreater(two.audit(), 0.0)

    def test_nees(self):
        one = cairn.Filter(initial_covariance=np.diag([4.0, 1, 1, 1, 1, 1]))
        self.assertAlmostEqual(one.pose_nees(([2.0, 0, 0], [1, 0, 0, 0])), 1.0)

    def test_health(self):
        made, sensor = filled()
        with made:
            health = made.health()
            self.assertEqual((health["verdict"], health["reasons"], health["words"]), (cairn.Verdict.GOOD, 0, ["good"]))
            for _ in range(10):
                made.update(sensor, list(support.LANDMARKS), seen() + np.array([7.0, 0.0, 0.0]))
            health = made.health()
            self.assertEqual(health["verdict"], cairn.Verdict.LOST)
            self.assertTrue(health["reasons"] & cairn.Doubts.REFUSALS)
            self.assertEqual(health["words"][0], "lost")
            self.assertEqual(len(health["words"]), 1 + bin(health["reasons"]).count("1"))
            of_sensor = made.sensor_health(sensor)
            self.assertEqual(of_sensor["refused"], 10 * len(support.LANDMARKS))
            self.assertEqual(of_sensor["persistence"].shape, (4,))
            with self.assertRaises(cairn.CairnError):
                made.sensor_health(1)

    def test_submaps(self):
        with cairn.Filter(submap_landmarks=100, max_landmarks=100, join="dense") as one:
            sensor = one.add_cartesian()
            one.predict_increment(([1.0, 0, 0], [1, 0, 0, 0]), 1e-4 * np.eye(6))
            one.update(sensor, [5, 6, 7], [[3, 0, 0], [0, 3, 0], [2, 2, 1]])
            self.assertEqual((len(one.map), len(one.local_map), one.submap_count), (0, 3, 0))
            self.assertEqual(one.last_closing()["reason"], cairn.ClosedBy.NONE)
            one.close_submap()
            told = one.last_closing()
            self.assertEqual((told["reason"], told["submaps"], told["landmarks"]), (cairn.ClosedBy.CALLER, 1, 3))
            self.assertEqual((len(one.map), len(one.local_map), one.submap_count), (3, 0, 1))
            np.testing.assert_allclose(one.map.landmark(5)["position"], [4, 0, 0], atol=1e-9)
            base, ids = one.submap(0)
            self.assertEqual(ids.tolist(), [5, 6, 7])
            np.testing.assert_allclose(base.position, 0, atol=1e-12)
            np.testing.assert_allclose(one.base_pose()[0], [1, 0, 0], atol=1e-9)
            np.testing.assert_allclose(one.local_pose()[2], 0, atol=1e-12)
            with self.assertRaises(cairn.CairnError) as caught:
                one.submap(1)
            self.assertEqual(caught.exception.status, cairn.Status.ERROR_NOT_FOUND)

    def test_trajectory(self):
        with cairn.Filter(submap_landmarks=50, trajectory_poses=2) as one:
            sensor = one.add_cartesian()
            for step in range(4):
                self.assertEqual(one.trajectory_range(), (max(0, step - 2), step))
                one.predict_increment(([1, 0, 0], [1, 0, 0, 0]), np.eye(6) * 1e-6)
                one.update(sensor, [1], [[5 - step, 0, 0]])
            one.close_submap()
            np.testing.assert_allclose(one.trajectory()["position"], [[3, 0, 0], [4, 0, 0]], atol=1e-9)
            np.testing.assert_allclose(one.trajectory(3)["quaternion"], [[1, 0, 0, 0]], atol=1e-9)
            with self.assertRaises(cairn.CairnError) as caught:
                one.trajectory(1)
            self.assertEqual(caught.exception.status, cairn.Status.ERROR_CAPACITY)
            self.assertEqual(one.keep_pose(), 4)
        with cairn.Filter() as none, self.assertRaises(cairn.CairnError) as caught:
            none.trajectory()
        self.assertEqual(caught.exception.status, cairn.Status.ERROR_STATE)

    def test_systematic_errors(self):
        with cairn.Filter(max_landmarks=20, velocity_bias_sigma=[0, 0.2, 0.1], max_sensor_errors=2) as one:
            sensor = one.add_cartesian(sigma=[0.1, 0.1, 0.2])
            one.calibrate_sensor(sensor, mount_turn_sigma=[0, 0, 0.02], offset_sigma=[0.3, 0, 0])
            errors = one.systematic_errors()
            self.assertEqual(list(errors["kind"]), [cairn.Systematic.VELOCITY_BIAS] * 2 +
                             [cairn.Systematic.MOUNT_TURN, cairn.Systematic.OFFSET])
            self.assertEqual(list(errors["component"]), [1, 2, 2, 0])
            self.assertEqual(list(errors["sensor"]), [-1, -1, sensor, sensor])
            np.testing.assert_allclose(errors["sigma"], [0.2, 0.1, 0.02, 0.3])
            np.testing.assert_allclose(one.systematic_covariance(), np.diag(errors["sigma"] ** 2))
            one.predict_wheels_gyro(0.5, 2, 2, [0, 0, 0.1])
            self.assertGreater(one.pose()[0][0], 0.1)
        with cairn.Filter() as none:
            self.assertEqual(len(none.systematic_errors()), 0)
            self.assertEqual(none.systematic_covariance().shape, (0, 0))
        with self.assertRaisesRegex(cairn.CairnError, "velocity_bias_walk") as caught:
            cairn.Filter(velocity_bias_walk=[0.1, 0, 0])
        self.assertEqual(caught.exception.status, cairn.Status.ERROR_ARGUMENT)

    def test_required_bytes(self):
        small, large = (cairn.Filter.required_bytes(max_landmarks=n) for n in (10, 1000))
        self.assertGreater(large, 8 * 3000 * 3000 / 2)
        self.assertLess(small, large / 10)


class CallbackTest(unittest.TestCase):
    @staticmethod
    def offset(pose, landmark):
        """Observes the point in the axes of the map, from a vehicle that does not rotate."""
        return landmark - pose.position, np.hstack([-np.eye(3), np.zeros((3, 3))]), np.eye(3)

    @staticmethod
    def place(pose, z):
        return pose.position + z, np.hstack([np.eye(3), np.zeros((3, 3))]), np.eye(3)

    def test_custom_sensor(self):
        one = cairn.Filter(initial_covariance=np.diag([1.0, 1, 1, 0, 0, 0]))
        sensor = one.add_custom(self.offset, self.place, sigma=[0.1] * 3)
        gc.collect()  # the filter keeps the functions alive
        self.assertEqual(one.update(sensor, [3], [[1.0, 2.0, 3.0]])["result"].tolist(), [cairn.Result.NEW])
        self.assertEqual(one.update(sensor, [3], [[1.0, 2.0, 3.1]])["result"].tolist(), [cairn.Result.MATCHED])
        bearing = one.add_custom(lambda pose, l: (l[:1] - pose.position[:1], [[-1.0, 0, 0, 0, 0, 0]], [[1.0, 0, 0]]), rows=1)
        match = one.update(bearing, [3], [[1.0]], covariance=[[[0.01]]])
        self.assertEqual(match["result"].tolist(), [cairn.Result.MATCHED])
        unseen = one.add_custom(lambda pose, landmark: None, rows=1)
        self.assertEqual(one.update(unseen, [3], [[1.0]])["reason"].tolist(), [cairn.Reason.NO_IMAGE])

    def test_what_a_callback_raises_comes_out(self):
        def broken(pose, landmark):
            raise ZeroDivisionError("in the model")

        one, sensor = filled()
        custom = one.add_custom(broken, rows=2)
        with self.assertRaisesRegex(ZeroDivisionError, "in the model"):
            one.update(custom, [7], [[1.0, 2.0]])
        wrong = one.add_custom(lambda pose, landmark: (np.zeros(2), np.zeros((2, 5)), np.zeros((2, 3))), rows=2)
        with self.assertRaisesRegex(ValueError, "jacobian_pose: shape 2 x 6"):
            one.update(wrong, [7], [[1.0, 2.0]])
        self.assertEqual(one.update(sensor, [7], seen([7]))["result"].tolist(), [cairn.Result.MATCHED])

    def test_an_exception_leaves_no_part_of_the_frame(self):
        calls = []

        def second_fails(pose, landmark):
            calls.append(landmark)
            if len(calls) == 2:
                raise KeyError("no calibration for this landmark")
            return landmark - pose.position, np.hstack([-np.eye(3), np.zeros((3, 3))]), np.eye(3)

        one = cairn.Filter(initial_covariance=np.eye(6) * 0.01)
        lidar, custom = one.add_cartesian(), one.add_custom(second_fails, sigma=[0.1] * 3)
        one.update(lidar, [1, 2], [[3, 0, 0], [0, 3, 0]])
        before, pose = one.map.landmark(1), one.pose()
        for _ in range(3):
            calls.clear()
            with self.assertRaisesRegex(KeyError, "no calibration"):
                one.update(custom, [1, 2], [[3.2, 0, 0], [0, 3, 0]])
            after = one.map.landmark(1)
            self.assertEqual(after["observations"], before["observations"])
            np.testing.assert_array_equal(after["position"], before["position"])
            np.testing.assert_array_equal(after["covariance"], before["covariance"])
            np.testing.assert_array_equal(one.pose()[2], pose[2])
        calls.extend([None, None])
        self.assertEqual(one.update(custom, [1, 2], [[3.2, 0, 0], [0, 3, 0]])["result"].tolist(), [cairn.Result.MATCHED] * 2)

    def test_a_callback_may_not_call_its_filter(self):
        one, _ = filled()
        custom = one.add_custom(lambda pose, landmark: one.pose(), rows=2)
        with self.assertRaisesRegex(cairn.CairnError, "in a call already"):
            one.update(custom, [7], [[1.0, 2.0]])
        closing = one.add_custom(lambda pose, landmark: one.close(), rows=2)
        with self.assertRaisesRegex(cairn.CairnError, "can't be closed now"):
            one.update(closing, [7], [[1.0, 2.0]])
        self.assertFalse(one.closed)

    def test_log(self):
        lines = []
        one, sensor = filled(gate_probability=1.0)  # only the batch gate can refuse
        one.set_log(lines.append)
        one.update(sensor, list(support.LANDMARKS), seen() + [[5.0, 0, 0], [-5.0, 0, 0], [0, 5.0, 0], [0, -5.0, 0]])
        one.set_log(None)
        count = len(lines)
        one.update(sensor, list(support.LANDMARKS), seen() - [[5.0, 0, 0], [-5.0, 0, 0], [0, 5.0, 0], [0, -5.0, 0]])
        self.assertGreater(count, 0)
        self.assertEqual(len(lines), count)
        self.assertTrue(all(isinstance(line, str) for line in lines))


class BadInputTest(unittest.TestCase):
    def refused(self, kind, told, call, *arguments, **options):
        with self.assertRaisesRegex(kind, told):
            call(*arguments, **options)

    def test_options(self):
        self.refused(TypeError, "no option 'max_landmark'.*max_landmarks", cairn.Filter, max_landmark=3)
        self.refused(TypeError, "no option 'struct_size'", cairn.Filter, struct_size=3)
        self.refused(TypeError, "max_landmarks", cairn.Filter, max_landmarks=2.5)
        self.refused(OverflowError, "max_landmarks", cairn.Filter, max_landmarks=-1)
        self.refused(ValueError, "state_error: must be one of 'invariant', 'standard'", cairn.Filter, state_error="odd")
        self.refused(TypeError, "state_error", cairn.Filter, state_error=0.5)
        self.refused(ValueError, "initial_covariance: shape 6 x 6", cairn.Filter, initial_covariance=np.eye(3))
        self.refused(ValueError, "initial_pose: must be a pose", cairn.Filter, initial_pose=[1, 2, 3])
        self.refused(ValueError, "initial_pose.quaternion: shape 4", cairn.Filter, initial_pose=([0, 0, 0], [1, 0, 0]))
        self.refused(cairn.CairnError, "CAIRN_ERROR_ARGUMENT.*max_landmarks", cairn.Filter, max_landmarks=0)
        self.refused(TypeError, "no option 'sigmas'", cairn.Filter().add_cartesian, sigmas=[1, 1, 1])

    def test_observations(self):
        one, sensor = filled()
        before = [part.tobytes() for part in one.pose()] + [one.map.landmarks().tobytes()]
        self.refused(ValueError, r"z: shape 2 x n", one.update, sensor, [1, 2], [[1.0, 2, 3]])
        self.refused(ValueError, "1 to 3 values", one.update, sensor, [1], [[1.0, 2, 3, 4]])
        self.refused(ValueError, "covariance: shape 1 x 3 x 3", one.update, sensor, [1], [[1.0, 2, 3]], np.eye(3))
        self.refused(TypeError, "ids: must be whole numbers", one.update, sensor, [1.5], [[1.0, 2, 3]])
        self.refused(TypeError, "ids: must be whole numbers", one.update, sensor, np.array([1.5]), [[1.0, 2, 3]])
        self.refused(ValueError, "id", one.update, sensor, [-1], [[1.0, 2, 3]])
        self.refused(ValueError, "negative", one.update, sensor, np.array([-1]), [[1.0, 2, 3]])
        self.refused(ValueError, "id", one.update, sensor, [2**64], [[1.0, 2, 3]])
        self.refused(TypeError, "z: must be numbers", one.update, sensor, [1], [["a", "b", "c"]])
        self.refused(TypeError, "z is missing", one.update, sensor, [1])
        for ids, z, word in (([7, 7], seen([7, 7]), "ARGUMENT"), ([2**64 - 1], seen([7]), "ARGUMENT"),
                             ([7], [[np.nan, 0, 0]], "ARGUMENT"), (np.arange(300), np.ones((300, 3)), "CAPACITY")):
            self.refused(cairn.CairnError, f"CAIRN_ERROR_{word}", one.update, sensor, ids, z)
        self.refused(cairn.CairnError, "CAIRN_ERROR_NOT_FOUND", one.update, sensor + 1, [7], seen([7]))
        self.refused(OverflowError, "", one.update, 2**40, [7], seen([7]))
        self.assertEqual(before, [part.tobytes() for part in one.pose()] + [one.map.landmarks().tobytes()])

    def test_other_arguments(self):
        one, _ = filled()
        self.refused(ValueError, "velocity: shape 3", one.predict_twist, 0.1, [1, 2], [0, 0, 0])
        self.refused(ValueError, "covariance: shape 6 x 6", one.predict_increment, LEVEL, np.zeros(36))
        self.refused(ValueError, "covariance: shape 3 x 3", one.update_position, [0, 0, 0], np.eye(2))
        self.refused(ValueError, "jacobian_landmarks: shape 1 x 3", one.update_linear, [0], [[1]], None, [7], [[1, 2]])
        self.refused(TypeError, "real numbers", one.update_attitude, np.array([1j, 0, 0, 0]), np.eye(3))
        self.refused(cairn.CairnError, "ARGUMENT", one.predict_wheels, -1.0, 1, 1)
        self.refused(TypeError, "", one.predict_wheels, "soon", 1, 1)
        self.refused(cairn.CairnError, "NOT_FOUND", one.remove_landmark, 99)

    def test_an_error_tells_its_status(self):
        with self.assertRaises(cairn.CairnError) as caught:
            cairn.Filter(max_landmarks=0)
        error = caught.exception
        self.assertEqual((error.status, error.name), (cairn.Status.ERROR_ARGUMENT, "CAIRN_ERROR_ARGUMENT"))
        self.assertIn("max_landmarks", error.message)
        again = pickle.loads(pickle.dumps(error))
        self.assertEqual((again.status, again.message), (error.status, error.message))

    def test_arrays_of_any_layout(self):
        one, sensor = filled()
        two, other = filled()
        ids = list(support.LANDMARKS)
        plain = one.update(sensor, ids, seen())
        z = np.asfortranarray(np.repeat(seen(), 2, axis=0))[::2]
        z.flags.writeable = False
        strided = two.update(other, np.array([[i, 0] for i in ids], dtype=np.int64)[:, 0], z)
        self.assertEqual(plain.tobytes(), strided.tobytes())
        self.assertEqual(two.update(other, ids, np.zeros((4, 3), np.float32))["result"].tolist(), [cairn.Result.REJECTED] * 4)


class LifetimeTest(unittest.TestCase):
    def test_use_after_close(self):
        one, sensor = filled()
        landmarks = one.map
        with one:
            self.assertEqual(len(landmarks), 4)
        self.assertTrue(one.closed and landmarks.closed)
        one.close()
        for call in (one.pose, lambda: one.map, one.last_update, one.audit, lambda: len(landmarks), landmarks.landmarks,
                     lambda: landmarks.within([0, 0, 0], 3), lambda: one.update(sensor, [7], seen([7])),
                     lambda: one.predict_wheels(0.1, 1, 1), lambda: one.add_cartesian()):
            with self.assertRaisesRegex(cairn.CairnError, "the filter is closed") as caught:
                call()
            self.assertEqual(caught.exception.status, cairn.Status.ERROR_STATE)

    def test_a_map_keeps_its_filter(self):
        one, _ = filled()
        gone, landmarks = weakref.ref(one), one.map
        expected = landmarks.landmarks().tobytes()
        del one
        gc.collect()
        self.assertIsNotNone(gone())
        self.assertEqual(landmarks.landmarks().tobytes(), expected)
        del landmarks
        gc.collect()
        self.assertIsNone(gone())

    def test_results_are_copies(self):
        one, sensor = filled()
        known, pose = one.map.landmarks(), one.pose()
        kept = known.copy(), [part.copy() for part in pose]
        one.predict_wheels(0.2, 3, 3)
        one.update(sensor, [7], seen([7]) - [0.18, 0, 0])
        one.close()
        self.assertEqual(known.tobytes(), kept[0].tobytes())
        for part, before in zip(pose, kept[1]):
            self.assertEqual(part.tobytes(), before.tobytes())

    def test_a_constructor_that_fails_leaves_nothing(self):
        for _ in range(100):
            with self.assertRaises(cairn.CairnError):
                cairn.Filter(max_landmarks=0)
        gc.collect()

    def test_memory_comes_back(self):
        def resident():
            with open("/proc/self/statm") as file:
                return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

        size = cairn.Filter.required_bytes(max_landmarks=500)
        for _ in range(3):
            cairn.Filter(max_landmarks=500)
        before = resident()
        for _ in range(40):
            cairn.Filter(max_landmarks=500).map
        gc.collect()
        self.assertLess(resident() - before, 10 * size)

    def test_no_copies_of_a_handle(self):
        one, _ = filled()
        for spread in (copy.copy, copy.deepcopy, pickle.dumps):
            with self.assertRaises(TypeError):
                spread(one)

    def test_threads_wait_for_each_other(self):
        one, sensor = filled()
        failures = []

        def work():
            try:
                for _ in range(200):
                    one.update(sensor, list(support.LANDMARKS), seen())
                    one.map.landmarks()
                    one.pose()
            except Exception as error:  # noqa: BLE001
                failures.append(error)

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])
        self.assertEqual(one.map.landmark(7)["observations"], 801)

    def test_messages_are_those_of_the_thread(self):
        told = []

        def fail(count):
            for _ in range(200):
                try:
                    cairn.Filter(max_sensors=count)
                except cairn.CairnError as error:
                    told.append((count, error.message))

        threads = [threading.Thread(target=fail, args=(count,)) for count in (1000, 2000)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(told), 400)
        self.assertTrue(all(str(count) in message for count, message in told), told[0])


if __name__ == "__main__":
    unittest.main()
