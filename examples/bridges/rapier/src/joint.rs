//! Rapier's impulse joints as bilateral rows.
use std::collections::HashMap;

use rapier3d::na::{Isometry3, Vector3};
use rapier3d::prelude::*;

use crate::contact::Inertia;

/// One locked axis of a joint.
pub struct Locked {
    pub first: RigidBodyHandle,
    pub second: RigidBodyHandle,
    pub jacobian_first: [f64; 6],
    pub jacobian_second: [f64; 6],
    /// How far it is off, m or rad.
    pub error: f64,
    pub key: u64,
}

/// The locked axes of all enabled joints. Limits, motors and coupled axes are refused: only what is locked is carried over.
pub fn locked(
    joints: &ImpulseJointSet,
    bodies: &RigidBodySet,
    inertias: &HashMap<RigidBodyHandle, Inertia>,
) -> Result<Vec<Locked>, String> {
    let mut rows = Vec::new();
    for (handle, joint) in joints.iter().filter(|(_, joint)| joint.data.is_enabled()) {
        let more = joint.data.limit_axes | joint.data.motor_axes | joint.data.coupled_axes;
        if !more.is_empty() {
            return Err(format!("joint {:?} has limits, motors or coupled axes: {more:?}", handle.0));
        }
        let frame =
            |body: RigidBodyHandle, local: &Isometry<Real>| -> Isometry3<f64> { (bodies[body].position() * local).cast() };
        let first = frame(joint.body1, &joint.data.local_frame1);
        let second = frame(joint.body2, &joint.data.local_frame2);
        let apart = second.translation.vector - first.translation.vector;
        let turned = (second.rotation * first.rotation.inverse()).scaled_axis();
        for index in (0..6).filter(|&index| joint.data.locked_axes.contains(JointAxesMask::from_bits_truncate(1 << index))) {
            let axis = first.rotation * Vector3::ith(index % 3, 1.0);
            let block = |body: RigidBodyHandle, axis: Vector3<f64>| {
                let Some(inertia) = inertias.get(&body) else { return [0.0; 6] };
                // the axis turns with the first body, so that both levers end at the second anchor
                let lever = second.translation.vector - inertia.centre.coords;
                let (linear, angular) = if index < 3 { (axis, lever.cross(&axis)) } else { (Vector3::zeros(), axis) };
                [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z]
            };
            rows.push(Locked {
                first: joint.body1,
                second: joint.body2,
                jacobian_first: block(joint.body1, -axis),
                jacobian_second: block(joint.body2, axis),
                error: if index < 3 { apart } else { turned }.dot(&axis),
                key: u64::from(handle.0.into_raw_parts().0) << 3 | index as u64 | 1 << 63,
            });
        }
    }
    Ok(rows)
}
