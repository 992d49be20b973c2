//! The contacts of Rapier's narrow phase, seen as rows of a problem.
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use rapier3d::na::{Matrix3, Point3, Vector3};
use rapier3d::prelude::*;

/// A dynamic body at the begin of a step, in double precision.
pub struct Inertia {
    pub mass: f64,
    /// About the centre of mass, along the axes of the world.
    pub inertia: Matrix3<f64>,
    pub centre: Point3<f64>,
    pub linear: Vector3<f64>,
    pub angular: Vector3<f64>,
    /// What gravity and the user's forces do.
    pub force: Vector3<f64>,
    pub torque: Vector3<f64>,
}

/// The dynamic bodies at the begin of a step. Everything else does not move.
pub fn inertias(bodies: &RigidBodySet, gravity: &Vector<Real>) -> HashMap<RigidBodyHandle, Inertia> {
    let dynamic = bodies.iter().filter(|(_, body)| body.is_dynamic());
    dynamic.map(|(handle, body)| (handle, Inertia::new(body, gravity))).collect()
}

impl Inertia {
    fn new(body: &RigidBody, gravity: &Vector<Real>) -> Self {
        let turn: Matrix3<f64> = body.rotation().to_rotation_matrix().into_inner().cast();
        let local: Matrix3<f64> = body.mass_properties().local_mprops.reconstruct_inertia_matrix().cast();
        let (inertia, mass) = (turn * local * turn.transpose(), f64::from(body.mass()));
        Inertia {
            mass,
            inertia: (inertia + inertia.transpose()) * 0.5, // symmetric to the last bit
            // Rapier's own centre is that of its last step
            centre: (body.position() * body.mass_properties().local_mprops.local_com).cast(),
            linear: body.linvel().cast(),
            angular: body.angvel().cast(),
            force: (gravity * body.gravity_scale()).cast() * mass + body.user_force().cast::<f64>(),
            torque: body.user_torque().cast(),
        }
    }
}

/// One point of a contact manifold with its normal and tangent rows.
pub struct Touch {
    /// Above: the normal points from `low` to `high`.
    pub high: RigidBodyHandle,
    pub low: RigidBodyHandle,
    /// Normal row, then tangent rows, six numbers each.
    pub jacobian_high: [f64; 18],
    pub jacobian_low: [f64; 18],
    /// Negative where the bodies overlap, m.
    pub gap: f64,
    pub friction: f64,
    /// The same as long as the same features touch.
    pub key: u64,
    /// What Rapier's own solver found last, N·s.
    pub impulse_of_rapier: f64,
}

/// The contacts that Rapier's solver would get, in the order of their colliders, between bodies as they were when their manifolds were made.
pub fn touches(narrow_phase: &NarrowPhase, inertias: &HashMap<RigidBodyHandle, Inertia>) -> Vec<Touch> {
    let mut touches = Vec::new();
    // the engine's order is that of a hash table; ours repeats
    let mut pairs: Vec<_> = narrow_phase.contact_pairs().collect();
    pairs.sort_by_key(|pair| [pair.collider1, pair.collider2].map(ColliderHandle::into_raw_parts));
    for pair in pairs {
        for manifold in &pair.manifolds {
            let (low, high) = (manifold.data.rigid_body1, manifold.data.rigid_body2);
            let (low, high) = (low.unwrap_or_default(), high.unwrap_or_default());
            if !inertias.contains_key(&low) && !inertias.contains_key(&high) {
                continue;
            }
            let forth = frame(manifold.data.normal.cast::<f64>().normalize());
            let back = forth.map(|direction| -direction);
            // points too far away have no solver contact; the others have one each, in the same order
            let mut points = manifold.points.iter();
            for contact in &manifold.data.solver_contacts {
                let Some(point) = points.find(|point| point.dist == contact.dist) else { break };
                let at = contact.point.cast();
                touches.push(Touch {
                    high,
                    low,
                    jacobian_high: inertias.get(&high).map_or([0.0; 18], |body| rows(&forth, &(at - body.centre))),
                    jacobian_low: inertias.get(&low).map_or([0.0; 18], |body| rows(&back, &(at - body.centre))),
                    gap: f64::from(contact.dist),
                    friction: f64::from(contact.friction),
                    key: key(pair.collider1, pair.collider2, point.fid1.0, point.fid2.0),
                    impulse_of_rapier: f64::from(point.data.impulse),
                });
            }
        }
    }
    touches
}

/// The normal and two tangents.
fn frame(normal: Vector3<f64>) -> [Vector3<f64>; 3] {
    let first = Vector3::ith(normal.iamin(), 1.0).cross(&normal).normalize();
    [normal, first, normal.cross(&first)]
}

/// Rows along `directions` for a point at `lever` from the centre of mass: direction and lever × direction.
fn rows(directions: &[Vector3<f64>; 3], lever: &Vector3<f64>) -> [f64; 18] {
    let mut rows = [0.0; 18];
    for (row, direction) in rows.chunks_exact_mut(6).zip(directions) {
        row[..3].copy_from_slice(direction.as_slice());
        row[3..].copy_from_slice(lever.cross(direction).as_slice());
    }
    rows
}

fn key(collider1: ColliderHandle, collider2: ColliderHandle, feature1: u32, feature2: u32) -> u64 {
    let mut hasher = DefaultHasher::new();
    (collider1, collider2, feature1, feature2).hash(&mut hasher);
    hasher.finish().max(1) // 0 would be none
}
