// SPDX-License-Identifier: BSD-3-Clause
//! The time of one update in Rust over the time of the same update in C. Both drive the same recorded mission in turns,
//! and each frame is compared by the median of its rounds.
use cairn::{Filter, FilterOptions, Match, Observation, Pose, Result, StereoHead, World, WorldMotion, WorldOptions};
use std::time::Instant;

const ROUNDS: usize = 21;

struct Frame {
    motions: Vec<WorldMotion>,
    observations: Vec<Observation>,
}

/// A frame as drive.c sees it.
#[repr(C)]
struct CFrame {
    motions: *const WorldMotion,
    motion_count: usize,
    observations: *const Observation,
    observation_count: usize,
}

extern "C" {
    fn cairn_timing_drive(
        max_observations: u32,
        start: *const Pose,
        frames: *const CFrame,
        count: usize,
        seconds: *mut f64,
        end: *mut Pose,
    ) -> i32;
}

fn drive_in_rust(max_observations: u32, start: &Pose, frames: &[Frame], seconds: &mut [f64]) -> Result<Pose> {
    let options = FilterOptions { submap_landmarks: 60, max_observations, initial_pose: *start, ..Default::default() };
    let mut filter = Filter::new(&options)?;
    let camera = filter.add_stereo_head(&StereoHead::default())?;
    let mut matches = vec![Match::default(); max_observations as usize];
    for (frame, seconds) in frames.iter().zip(seconds) {
        for motion in &frame.motions {
            filter.predict_twist(motion.dt, &motion.velocity, &motion.rate)?;
        }
        let matches = &mut matches[..frame.observations.len()];
        let before = Instant::now();
        filter.update_into(camera, &frame.observations, matches)?;
        *seconds = before.elapsed().as_secs_f64();
    }
    Ok(filter.pose()?.0)
}

fn drive_in_c(max_observations: u32, start: &Pose, frames: &[Frame], seconds: &mut [f64]) -> Pose {
    let frames: Vec<CFrame> = frames
        .iter()
        .map(|frame| CFrame {
            motions: frame.motions.as_ptr(),
            motion_count: frame.motions.len(),
            observations: frame.observations.as_ptr(),
            observation_count: frame.observations.len(),
        })
        .collect();
    let mut end = Pose::identity();
    // SAFETY: the frames point to arrays of the stated lengths, which have the layout of C.
    let status = unsafe {
        cairn_timing_drive(max_observations, start, frames.as_ptr(), frames.len(), seconds.as_mut_ptr(), &mut end)
    };
    assert_eq!(status, 0, "{}", cairn::last_message());
    end
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn main() -> Result<()> {
    let mut world = World::new(&WorldOptions { seed: 3, ..Default::default() })?;
    let (start, max_observations) = (world.pose(0.0)?, world.most_observations()? as u32);
    let mut frames = Vec::new();
    while world.next_step()?.is_some() {
        frames.push(Frame { motions: world.motions()?, observations: world.observations()? });
    }
    let mut times = vec![[[0.0; ROUNDS]; 2]; frames.len()];
    let mut seconds = vec![0.0; frames.len()];
    for round in 0..ROUNDS {
        let mut ends = [Pose::identity(); 2];
        for turn in 0..2 {
            let language = (round + turn) % 2; // who begins changes with each round
            ends[language] = match language {
                0 => drive_in_c(max_observations, &start, &frames, &mut seconds),
                _ => drive_in_rust(max_observations, &start, &frames, &mut seconds)?,
            };
            for (frame, seconds) in times.iter_mut().zip(&seconds) {
                frame[language][round] = *seconds;
            }
        }
        assert_eq!(ends[0], ends[1], "both drives end at the same pose");
    }
    let medians: Vec<[f64; 2]> = times.iter_mut().map(|frame| [0, 1].map(|i| median(&mut frame[i]))).collect();
    let microseconds = [0, 1].map(|i| 1e6 * median(&mut medians.iter().map(|frame| frame[i]).collect::<Vec<_>>()));
    let ratio = median(&mut medians.iter().map(|frame| frame[1] / frame[0]).collect::<Vec<_>>());
    println!(
        "one update: C {:.2} us, Rust {:.2} us; Rust over C {:+.2} %; median of {} frames, each of {ROUNDS} rounds",
        microseconds[0],
        microseconds[1],
        100.0 * (ratio - 1.0),
        frames.len()
    );
    Ok(())
}
