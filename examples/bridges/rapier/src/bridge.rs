//! A Rapier scene stepped with mlcp: Rapier detects collisions, mlcp finds velocities and impulses, positions follow.
use std::collections::HashMap;

use mlcp::{Body, Contacts, Problem, Rows, Solver, strided};
use rapier3d::na::Vector3;
use rapier3d::prelude::*;

use crate::contact::{Inertia, Touch, inertias, touches};
use crate::joint::{Locked, locked};
use crate::scene::Scene;
use crate::step::{Failure, Step};

/// The part of an overlap, and of a joint's error, that a step takes away.
const STABILISATION: f64 = 0.2;

/// Solver, problem and the names of bodies, kept from step to step.
pub struct Bridge {
    pipeline: CollisionPipeline,
    problem: Problem,
    solver: Solver,
    ids: HashMap<RigidBodyHandle, Body>,
}

impl Bridge {
    pub fn new() -> mlcp::Result<Self> {
        let (problem, solver) = (Problem::new()?, Solver::new()?);
        Ok(Bridge { pipeline: CollisionPipeline::new(), problem, solver, ids: HashMap::new() })
    }

    /// One step of the scene, from collision detection to the new positions.
    pub fn step(&mut self, scene: &mut Scene) -> Result<Step, Failure> {
        self.pipeline.step(
            scene.parameters.prediction_distance(),
            &mut scene.broad_phase,
            &mut scene.narrow_phase,
            &mut scene.bodies,
            &mut scene.colliders,
            None,
            &(),
            &(),
        );
        let h = f64::from(scene.parameters.dt);
        let inertias = inertias(&scene.bodies, &scene.gravity);
        let touches = touches(&scene.narrow_phase, &inertias);
        let locked = locked(&scene.joints, &scene.bodies, &inertias)?;
        self.problem.clear_rows()?;
        self.set_bodies(&scene.bodies, &inertias, h)?;
        self.add_joints(&locked, h)?;
        self.add_contacts(&touches, h)?;
        let report = self.solver.solve(&self.problem)?;
        self.move_bodies(scene)?;
        let normal_rows = self.solver.impulses()?[locked.len()..].iter().step_by(3);
        let impulses = normal_rows.copied().collect();
        Ok(Step { inertias, touches, impulses, report: Some(report) })
    }

    /// Masses and k = M v + h q; bodies that came are added, those that went removed. The order is the engine's, so that bits repeat.
    fn set_bodies(&mut self, bodies: &RigidBodySet, inertias: &HashMap<RigidBodyHandle, Inertia>, h: f64) -> mlcp::Result<()> {
        let gone: Vec<_> = self.ids.keys().filter(|handle| !inertias.contains_key(handle)).copied().collect();
        for handle in gone {
            self.ids.remove(&handle).map_or(Ok(()), |id| self.problem.remove_body(id))?;
        }
        let present = || bodies.iter().filter_map(|(handle, _)| inertias.get_key_value(&handle));
        for (handle, inertia) in present() {
            let mass = mass_matrix(inertia);
            match self.ids.get(handle) {
                Some(&id) => self.problem.set_mass(id, &mass)?,
                None => drop(self.ids.insert(*handle, self.problem.add_body(6, &mass)?)),
            }
        }
        let n = self.problem.velocity_count();
        let (mut v, mut q) = (vec![0.0; n], vec![0.0; n]);
        for (handle, inertia) in present() {
            let range = self.problem.body_range(self.ids[handle])?;
            v[range.clone()].copy_from_slice(&six(&inertia.linear, &inertia.angular));
            q[range].copy_from_slice(&six(&inertia.force, &inertia.torque));
        }
        self.problem.set_momentum_of_step(h, &v, &q)
    }

    fn add_joints(&mut self, locked: &[Locked], h: f64) -> mlcp::Result<()> {
        let (first, second) = (self.bodies(locked.iter().map(|row| row.first)), self.bodies(locked.iter().map(|row| row.second)));
        let errors: Vec<f64> = locked.iter().map(|row| row.error).collect();
        let mut r = vec![0.0; locked.len()];
        mlcp::timestep::rows(h, STABILISATION, false, &errors, None, &mut r)?;
        let rows = Rows::new(locked.len())
            .body_a(&first)
            .body_b(&second)
            .jacobian_a(strided!(locked, Locked, jacobian_first))
            .jacobian_b(strided!(locked, Locked, jacobian_second))
            .r(&r);
        let (lo, hi) = (vec![f64::NEG_INFINITY; locked.len()], vec![f64::INFINITY; locked.len()]);
        let keys: Vec<u64> = locked.iter().map(|row| row.key).collect();
        self.problem.add_rows(&rows.lo(&lo).hi(&hi).key(&keys))?;
        Ok(())
    }

    fn add_contacts(&mut self, touches: &[Touch], h: f64) -> mlcp::Result<()> {
        let (high, low) =
            (self.bodies(touches.iter().map(|touch| touch.high)), self.bodies(touches.iter().map(|touch| touch.low)));
        // an open gap may close in the step but not more; an overlap is taken away bit by bit
        let gaps: Vec<f64> = touches.iter().map(|touch| touch.gap).collect();
        let mut closing = vec![0.0; touches.len()];
        mlcp::timestep::rows(h, STABILISATION, true, &gaps, None, &mut closing)?;
        let r: Vec<[f64; 3]> = closing.into_iter().map(|r| [r, 0.0, 0.0]).collect();
        let contacts = Contacts::spatial(touches.len())
            .body_a(&high)
            .body_b(&low)
            .jacobian_a(strided!(touches, Touch, jacobian_high))
            .jacobian_b(strided!(touches, Touch, jacobian_low))
            .r(r.as_flattened())
            .mu(strided!(touches, Touch, friction))
            .key(strided!(touches, Touch, key));
        self.problem.add_contacts(&contacts)?;
        Ok(())
    }

    fn bodies(&self, handles: impl Iterator<Item = RigidBodyHandle>) -> Vec<Body> {
        handles.map(|handle| self.ids.get(&handle).copied().unwrap_or(Body::WORLD)).collect()
    }

    /// Velocities go back, and positions follow them.
    fn move_bodies(&self, scene: &mut Scene) -> mlcp::Result<()> {
        let v = self.solver.velocities()?;
        for (&handle, &id) in &self.ids {
            let at = self.problem.body_range(id)?.start;
            let number = |i: usize| v[at + i] as Real;
            let velocity = RigidBodyVelocity {
                linvel: vector![number(0), number(1), number(2)],
                angvel: vector![number(3), number(4), number(5)],
            };
            let body = &mut scene.bodies[handle];
            let centre = body.mass_properties().local_mprops.local_com;
            let position = velocity.integrate(scene.parameters.dt, body.position(), &centre);
            body.set_linvel(velocity.linvel, false);
            body.set_angvel(velocity.angvel, false);
            body.set_position(position, false);
        }
        Ok(())
    }
}

fn six(linear: &Vector3<f64>, angular: &Vector3<f64>) -> [f64; 6] {
    [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z]
}

fn mass_matrix(inertia: &Inertia) -> [f64; 36] {
    let mut mass = [0.0; 36];
    for i in 0..3 {
        mass[7 * i] = inertia.mass;
        for j in 0..3 {
            mass[6 * (i + 3) + j + 3] = inertia.inertia[(i, j)];
        }
    }
    mass
}
