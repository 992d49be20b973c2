//! Contacts and joints of running Rapier scenes solved by mlcp, beside Rapier's own solver. Prints a table.
//!     rapier-bridge [SECONDS [PICTURE.svg]]     simulated seconds a scene, 10; the first scene at the end, seen from the side
mod bridge;
mod contact;
mod engine;
mod joint;
mod picture;
mod scene;
mod step;

use std::time::Instant;

use bridge::Bridge;
use engine::Engine;
use picture::View;
use scene::{Scene, chain_with_weight, heavy_on_light, tall_stack};
use step::{Failure, Step};

/// What is told of a run.
struct Summary {
    scene: Scene,
    /// Largest overlap after the first step, m.
    penetration: f64,
    /// Largest distance between the anchors of a joint, m.
    joint_error: f64,
    /// Largest of a step over the second half of the run, m/s; `None` without contacts.
    contact_error: Option<f64>,
    /// Median, from collision detection to positions, ms.
    step_ms: f64,
    /// Worst of mlcp's own reports.
    largest_error: f64,
    unsolved: usize,
}

const STEPS_A_SECOND: u16 = 60;

/// Steps a scene for that many seconds, `substeps` times each 60th of a second, and measures after the last.
fn run(
    mut scene: Scene,
    seconds: f64,
    substeps: u16,
    mut step: impl FnMut(&mut Scene) -> Result<Step, Failure>,
) -> Result<Summary, Failure> {
    let steps = (seconds * f64::from(STEPS_A_SECOND)).round() as usize;
    scene.parameters.dt = f32::from(STEPS_A_SECOND * substeps).recip();
    let h = f64::from(scene.parameters.dt);
    let mut times = Vec::new();
    let (mut penetration, mut joint_error, mut largest_error, mut unsolved) = (0.0f64, 0.0f64, 0.0f64, 0);
    let mut contact_error = None;
    for number in 0..steps {
        let start = Instant::now();
        for _ in 1..substeps {
            step(&mut scene)?;
        }
        let done = step(&mut scene)?;
        times.push(start.elapsed().as_secs_f64() * 1e3);
        joint_error = joint_error.max(scene.joint_error());
        if number > 0 {
            penetration = penetration.max(done.penetration());
        }
        if number >= steps / 2 && !done.touches.is_empty() {
            contact_error = Some(done.contact_error(&scene.bodies, h).max(contact_error.unwrap_or(0.0)));
        }
        if let Some(report) = done.report {
            largest_error = largest_error.max(report.largest_error);
            unsolved += usize::from(!report.is_solved());
        }
    }
    times.sort_by(f64::total_cmp);
    let step_ms = times.get(steps / 2).copied().ok_or("no steps")?;
    Ok(Summary { scene, penetration, joint_error, contact_error, step_ms, largest_error, unsolved })
}

/// Rapier as it comes, with its 4 iterations, which are substeps; with ten times as many; and mlcp.
fn compare(name: &str, build: impl Fn() -> Scene, seconds: f64, substeps: u16) -> Result<[Summary; 3], Failure> {
    let rapier = |iterations: usize| {
        let (mut scene, mut engine) = (build(), Engine::new());
        scene.parameters.num_solver_iterations = iterations.try_into()?;
        run(scene, seconds, 1, |scene| Ok(engine.step(scene)))
    };
    let mut bridge = Bridge::new()?;
    let summaries = [rapier(4)?, rapier(40)?, run(build(), seconds, substeps, |scene| bridge.step(scene))?];
    let mlcp = if substeps == 1 { "mlcp".into() } else { format!("mlcp, {substeps} substeps") };
    for (solver, of) in ["Rapier", "Rapier, 40 iterations", &mlcp].iter().zip(&summaries) {
        let (overlap, joint, drift) = (of.penetration * 1e3, of.joint_error * 1e3, of.scene.drift());
        let drift = if drift > 0.5 { "fell over".into() } else { format!("{:.2}", drift * 1e3) };
        let (error, time) = (of.contact_error.map_or("-".into(), |error| format!("{error:.0e}")), of.step_ms);
        let contacts = if of.contact_error.is_some() { format!("{overlap:.3} | {drift}") } else { "- | -".into() };
        let joint = if of.scene.joints.is_empty() { "-".into() } else { format!("{joint:.3}") };
        println!("| {name} | {solver} | {contacts} | {joint} | {error} | {time:.2} |");
    }
    let [.., mlcp] = &summaries;
    eprintln!("{name}: largest error that mlcp reports {:.0e}, {} solves not solved", mlcp.largest_error, mlcp.unsolved);
    Ok(summaries)
}

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let seconds = arguments.next().map_or(Ok(10.0), |text| text.parse())?;
    println!(
        "| scene, {seconds} s | solver | overlap, mm | moved sideways, mm | joints apart, mm | contact error, m/s | step, ms |"
    );
    println!("|---|---|---|---|---|---|---|");
    let heavy = compare("1000 kg on five cubes of 1 kg", || heavy_on_light(1000.0), seconds, 1)?;
    compare("stack of 30 cubes", || tall_stack(30), seconds, 1)?;
    compare("ten links of 1 kg, 100 kg at their end", || chain_with_weight(100.0), seconds, 4)?;
    if let Some(path) = arguments.next() {
        let titles = ["Rapier", "Rapier, 40 iterations", "mlcp"];
        let views = heavy.iter().zip(titles).map(|(of, title)| View { title, scene: &of.scene });
        svg::save(path, &picture::draw(&views.collect::<Vec<_>>(), 6.6))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use rapier3d::prelude::{IslandManager, JointAxis, MultibodyJointSet};

    use super::*;

    const SECONDS: f64 = 2.0;

    fn by_mlcp(scene: Scene, substeps: u16) -> Summary {
        let mut bridge = Bridge::new().unwrap();
        let of = run(scene, SECONDS, substeps, |scene| bridge.step(scene)).unwrap();
        assert!(of.unsolved == 0 && of.largest_error <= 1e-9, "{} not solved, error {}", of.unsolved, of.largest_error);
        of
    }

    #[test]
    fn a_heavy_cube_rests_on_light_ones_and_is_carried() {
        let of = by_mlcp(heavy_on_light(1000.0), 1);
        // velocities are rounded to single precision on their way to the engine
        assert!(of.penetration < 1e-5 && of.scene.drift() < 1e-5 && of.contact_error.unwrap() < 1e-5);
        let rapier = run(heavy_on_light(1000.0), SECONDS, 1, {
            let mut engine = Engine::new();
            move |scene| Ok(engine.step(scene))
        });
        assert!(rapier.unwrap().penetration > 1e-2, "the scene no longer shows the difference");
    }

    #[test]
    fn impulses_carry_the_weight_above_every_cube() {
        let (mut scene, mut bridge) = (tall_stack(4), Bridge::new().unwrap());
        let mut last = None;
        for _ in 0..60 {
            last = Some(bridge.step(&mut scene).unwrap());
        }
        let (step, h) = (last.unwrap(), f64::from(scene.parameters.dt));
        for (level, (handle, _)) in scene.placed.iter().enumerate() {
            let below = step.touches.iter().zip(&step.impulses).filter(|(touch, _)| touch.high == *handle);
            let above = step.touches.iter().zip(&step.impulses).filter(|(touch, _)| touch.low == *handle);
            let net: f64 = below.map(|(_, impulse)| impulse).sum::<f64>() - above.map(|(_, impulse)| impulse).sum::<f64>();
            assert!((net.abs() - 9.81 * h).abs() < 1e-3 * h, "cube {level} gets {net} N.s");
        }
    }

    #[test]
    fn a_swinging_chain_stays_together() {
        let of = by_mlcp(chain_with_weight(100.0), 4);
        assert!(of.joint_error < 1e-4, "{} m apart", of.joint_error);
        assert!(of.scene.drift() > 0.5, "it swings");
    }

    #[test]
    fn steps_repeat_to_the_bit() {
        let [one, other] = [(); 2].map(|()| by_mlcp(tall_stack(6), 1).scene);
        for (handle, _) in &one.placed {
            assert_eq!(one.bodies[*handle].position(), other.bodies[*handle].position());
        }
    }

    #[test]
    fn bodies_come_and_go() {
        let (mut scene, mut bridge) = (tall_stack(3), Bridge::new().unwrap());
        bridge.step(&mut scene).unwrap();
        let (top, _) = scene.placed.pop().unwrap();
        let mut islands = IslandManager::new();
        let (joints, multibodies) = (&mut scene.joints, &mut MultibodyJointSet::new());
        scene.bodies.remove(top, &mut islands, &mut scene.colliders, joints, multibodies, true);
        let step = bridge.step(&mut scene).unwrap();
        assert!(step.report.unwrap().is_solved() && step.inertias.len() == 2);
        assert!(step.touches.iter().all(|touch| touch.high != top && touch.low != top));
    }

    #[test]
    fn joints_with_motors_are_refused() {
        let mut scene = chain_with_weight(1.0);
        let handle = scene.joints.iter().next().unwrap().0;
        scene.joints.get_mut(handle, true).unwrap().data.set_motor_velocity(JointAxis::AngX, 1.0, 1.0);
        let error = Bridge::new().unwrap().step(&mut scene).err().unwrap().to_string();
        assert!(error.contains("has limits, motors or coupled axes"), "{error}");
    }
}
