//! Rapier's own solver.
use rapier3d::prelude::*;

use crate::contact::{inertias, touches};
use crate::scene::Scene;
use crate::step::Step;

/// The parts of Rapier that the bridge does without.
pub struct Engine {
    pipeline: PhysicsPipeline,
    islands: IslandManager,
    multibodies: MultibodyJointSet,
    ccd: CCDSolver,
}

impl Engine {
    pub fn new() -> Self {
        Engine {
            pipeline: PhysicsPipeline::new(),
            islands: IslandManager::new(),
            multibodies: MultibodyJointSet::new(),
            ccd: CCDSolver::new(),
        }
    }

    pub fn step(&mut self, scene: &mut Scene) -> Step {
        let inertias = inertias(&scene.bodies, &scene.gravity);
        self.pipeline.step(
            &scene.gravity,
            &scene.parameters,
            &mut self.islands,
            &mut scene.broad_phase,
            &mut scene.narrow_phase,
            &mut scene.bodies,
            &mut scene.colliders,
            &mut scene.joints,
            &mut self.multibodies,
            &mut self.ccd,
            None,
            &(),
            &(),
        );
        let touches = touches(&scene.narrow_phase, &inertias);
        let impulses = touches.iter().map(|touch| touch.impulse_of_rapier).collect();
        Step { inertias, touches, impulses, report: None }
    }
}
