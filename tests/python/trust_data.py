# SPDX-License-Identifier: BSD-3-Clause
"""Files of a run that lasts 200 s, with a slip between 80 s and 100 s and a wheel that is 2 % too large."""
import os

import numpy as np

HEALTH = ("step,t_s,verdict,reasons,nis_per_row,nis_lower,nis_upper,refused_share,widened,motion_scale,motion_scale_sigma,"
          "sensor_scale,sensor_scale_sigma,persistence,bias_sigmas,jump_sigmas,pose_pivot,blind_directions,"
          "contradicting_landmarks\n")
STEPS = 200


def health(step):
    """The fields of a line of health.csv."""
    slip = 80 <= step < 100
    verdict, reasons = ("lost", "refusals|jump") if slip else ("doubtful", "refusals") if 100 <= step < 110 else ("good", "")
    scale = "" if step < 20 else f"{1 + step / 400:.3f},{20 / step:.3f},0.9,{10 / step:.3f}"
    return [step, step, verdict, reasons, "" if step == 0 else 5.0 if slip else 1.0, 0.8, 1.25, 0.4 if slip else 0.01,
            2.5 if step == 99 else 0, *(scale.split(",") if scale else [""] * 4), 0.1, 1.0, 6.0 if slip else 0.5, 0.3, 0, 0]


def health_csv(start=0):
    lines = [health(step) for step in range(STEPS)]
    return HEALTH + "".join(",".join(map(str, [line[0], line[1] + start, *line[2:]])) + "\n" for line in lines)


def systematic_csv(start=0):
    rows = ["step,time,name,value,sigma"]
    for step in range(STEPS):
        for name, end in (("wheel scale left []", 0.02), ("gyro bias z [rad/s]", -0.002)):
            rows.append(f"{step},{step + start},{name},{end * (1 - 0.98 ** step):.9g},{abs(end) * 0.99 ** step:.9g}")
    return "\n".join(rows) + "\n"


def truth(step):
    return np.array([50 * np.cos(step / 30), 50 * np.sin(step / 30), 0.0])


def trajectory_csv(with_truth=True, start=0):
    """The online positions have an error of 0.03 m along z."""
    rows = ["step,t_s,x_m,y_m,z_m,true_x_m,true_y_m,true_z_m"]
    for step in range(STEPS):
        x, y, z = truth(step)
        rows.append(f"{step},{step + start},{x},{y},{z + 0.03}," + (f"{x},{y},{z}" if with_truth else ",,"))
    return "\n".join(rows) + "\n"


def tum(error, steps=range(STEPS), jitter=0.0):
    """A trajectory whose positions are wrong by `error` along z."""
    lines = []
    for step in steps:
        x, y, z = truth(step)
        lines.append(f"{step + jitter:.9f} {x:.9f} {y:.9f} {z + error:.9f} 0 0 0 1")
    return "# time x y z qx qy qz qw\n" + "\n".join(lines) + "\n"


def write(folder, **files):
    """health="..." writes health.csv; a name that ends in _tum writes a .tum file."""
    for name, text in files.items():
        file_name = name[:-4] + ".tum" if name.endswith("_tum") else name + ".csv"
        with open(os.path.join(folder, file_name), "w") as file:
            file.write(text)


def write_all(folder):
    write(folder, trajectory=trajectory_csv(), health=health_csv(), systematic=systematic_csv(),
          trajectory_online_tum=tum(0.03), trajectory_corrected_tum=tum(0.01, range(50, STEPS)))
