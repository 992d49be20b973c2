//! What a step of either solver leaves to be measured.
use std::collections::HashMap;

use mlcp::Report;
use rapier3d::na::Vector6;
use rapier3d::prelude::*;

use crate::contact::{Inertia, Touch};

pub type Failure = Box<dyn std::error::Error>;

pub struct Step {
    /// Of the bodies at its begin.
    pub inertias: HashMap<RigidBodyHandle, Inertia>,
    pub touches: Vec<Touch>,
    /// Normal impulse of each touch, N·s.
    pub impulses: Vec<f64>,
    /// mlcp's own.
    pub report: Option<Report>,
}

impl Step {
    /// The deepest overlap at the begin of the step, m.
    pub fn penetration(&self) -> f64 {
        self.touches.iter().map(|touch| -touch.gap).fold(0.0, f64::max)
    }

    /// How far velocities and impulses are from the law of contact, m/s: `max |min(w, a γ)|` over contacts, with `w = J v + max(gap, 0)/h` and
    /// `a = J M⁻¹ Jᵀ`. 0: no contact is approached faster than its gap allows, and only closed ones push. The bodies' velocities are those after the step.
    pub fn contact_error(&self, bodies: &RigidBodySet, h: f64) -> f64 {
        let one = |(touch, impulse): (&Touch, &f64)| {
            let sides = [(touch.high, &touch.jacobian_high), (touch.low, &touch.jacobian_low)];
            let (mut w, mut a) = (touch.gap.max(0.0) / h, 0.0);
            for (handle, jacobian) in sides {
                let Some(inertia) = self.inertias.get(&handle) else { continue };
                let row = Vector6::from_column_slice(&jacobian[..6]);
                let (linear, angular) = (row.fixed_rows::<3>(0), row.fixed_rows::<3>(3));
                let (body, turn) = (&bodies[handle], inertia.inertia.try_inverse().unwrap_or_default());
                w += linear.dot(&body.linvel().cast()) + angular.dot(&body.angvel().cast());
                a += linear.norm_squared() / inertia.mass + (turn * angular).dot(&angular);
            }
            w.min(a * impulse).abs()
        };
        self.touches.iter().zip(&self.impulses).map(one).fold(0.0, f64::max)
    }
}
