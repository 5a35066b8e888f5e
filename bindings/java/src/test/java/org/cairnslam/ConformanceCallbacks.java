// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import java.util.Map;

/** The functions that scenarios name: tests/conformance/README.md. */
final class ConformanceCallbacks {
  /** What a function throws that aborts. */
  static final class Aborted extends RuntimeException {
    private static final long serialVersionUID = 1L;
  }

  private interface Prediction {
    boolean predict(double[][] r, double[] d, double[] z, double[] pose, double[] landmark);
  }

  static final Map<String, CustomPredict> PREDICT = Map.of(
      "body_point", predict(ConformanceCallbacks::bodyPoint),
      "body_point_ahead", predict(ConformanceCallbacks::bodyPointAhead),
      "range_only", predict(ConformanceCallbacks::rangeOnly),
      "wrong_jacobian", predict((r, d, z, pose, landmark) -> {
        bodyPoint(r, d, z, pose, landmark);
        landmark[0] = r[0][0] + 0.5;
        return true;
      }),
      "unfinished", predict((r, d, z, pose, landmark) -> {
        bodyPoint(r, d, z, pose, landmark);
        pose[0] = Double.NaN;
        return true;
      }),
      "refusing", predict((r, d, z, pose, landmark) -> false),
      "aborting", predict((r, d, z, pose, landmark) -> {
        throw new Aborted();
      }));

  static final Map<String, CustomPlace> PLACE = Map.of(
      "body_point", ConformanceCallbacks::place,
      "refusing", (pose, z, landmark, jacobianPose, jacobianZ) -> false,
      "aborting", (pose, z, landmark, jacobianPose, jacobianZ) -> {
        throw new Aborted();
      });

  private ConformanceCallbacks() {}

  private static double[][] rotation(Pose pose) {
    final double w = pose.quaternionAt(0);
    final double x = pose.quaternionAt(1);
    final double y = pose.quaternionAt(2);
    final double z = pose.quaternionAt(3);
    return new double[][] {
      {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
      {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
      {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  }

  private static CustomPredict predict(Prediction prediction) {
    return (pose, landmark, z, jacobianPose, jacobianLandmark) -> {
      final double[] p = pose.position();
      final double[] d = {landmark[0] - p[0], landmark[1] - p[1], landmark[2] - p[2]};
      return prediction.predict(rotation(pose), d, z, jacobianPose, jacobianLandmark);
    };
  }

  private static double inBody(double[][] r, double[] d, int i) {
    return r[0][i] * d[0] + r[1][i] * d[1] + r[2][i] * d[2];
  }

  private static boolean bodyPoint(double[][] r, double[] d, double[] z, double[] pose, double[] landmark) {
    for (int i = 0; i < z.length; ++i) {
      z[i] = inBody(r, d, i);
      for (int j = 0; j < 3; ++j) {
        pose[6 * i + j] = -r[j][i];
        landmark[3 * i + j] = r[j][i];
      }
      pose[6 * i + 3] = r[1][i] * d[2] - r[2][i] * d[1];
      pose[6 * i + 4] = r[2][i] * d[0] - r[0][i] * d[2];
      pose[6 * i + 5] = r[0][i] * d[1] - r[1][i] * d[0];
    }
    return true;
  }

  private static boolean bodyPointAhead(double[][] r, double[] d, double[] z, double[] pose, double[] landmark) {
    final double ahead = inBody(r, d, 0);
    if (ahead < -5) {
      throw new Aborted();
    }
    return ahead >= 0 && bodyPoint(r, d, z, pose, landmark);
  }

  private static boolean rangeOnly(double[][] r, double[] d, double[] z, double[] pose, double[] landmark) {
    final double range = Math.sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (range < 0.1) {
      return false;
    }
    z[0] = range;
    for (int i = 0; i < 3; ++i) {
      pose[i] = -(d[i] / range);
      pose[3 + i] = 0;
      landmark[i] = d[i] / range;
    }
    return true;
  }

  private static boolean place(Pose pose, double[] z, double[] landmark, double[] jacobianPose, double[] jacobianZ) {
    final double[][] r = rotation(pose);
    final double[] p = pose.position();
    final int rows = z.length;
    final double[] c = new double[3];
    final double[] point = {z[0], rows > 1 ? z[1] : 0, rows > 2 ? z[2] : 0};
    for (int i = 0; i < 3; ++i) {
      c[i] = r[i][0] * point[0] + r[i][1] * point[1] + r[i][2] * point[2];
      landmark[i] = p[i] + c[i];
      for (int j = 0; j < rows; ++j) {
        jacobianZ[rows * i + j] = r[i][j];
      }
    }
    final double[] rowsOfPose = {1, 0, 0, 0, c[2], -c[1], 0, 1, 0, -c[2], 0, c[0], 0, 0, 1, c[1], -c[0], 0};
    System.arraycopy(rowsOfPose, 0, jacobianPose, 0, rowsOfPose.length);
    return true;
  }
}
