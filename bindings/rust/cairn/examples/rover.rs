// SPDX-License-Identifier: BSD-3-Clause
//! A simulated rover drives a circle among rocks: `cargo run --example rover`.
use cairn::{Filter, FilterOptions, Pose, Result, World, WorldOptions};

fn main() -> Result<()> {
    let mut world = World::new(&WorldOptions { seed: 3, ..Default::default() })?;
    let mut rover = Filter::new(&FilterOptions {
        submap_landmarks: 60, // close a submap when it holds this many
        max_observations: world.most_observations()? as u32,
        initial_pose: world.pose(0.0)?,
        ..Default::default()
    })?;
    let camera = rover.add_stereo_head(&world.head()?)?;

    let mut truth = Pose::identity();
    while let Some(step) = world.next_step()? {
        for motion in world.motions()? {
            rover.predict_twist(motion.dt, &motion.velocity, &motion.rate)?;
        }
        rover.point_head(camera, step.pan, step.stick)?;
        rover.update(camera, &world.observations()?)?;
        truth = step.truth;
    }

    let (pose, covariance) = rover.pose()?;
    let landmarks = rover.map().within(&pose.position, 30.0)?;
    let health = rover.health()?;
    for (axis, name) in ["x", "y", "z"].iter().enumerate() {
        let sigma = covariance[7 * axis].sqrt();
        println!("{name} {:8.3} +- {:.3} m, true {:8.3} m", pose.position[axis], 3.0 * sigma, truth.position[axis]);
    }
    println!("{} landmarks within 30 m; the verdict is {}", landmarks.len(), health.verdict.text());
    Ok(())
}
