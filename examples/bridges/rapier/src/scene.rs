//! The scenes, as any program that uses Rapier builds them.
use rapier3d::prelude::*;

/// What both solvers step.
pub struct Scene {
    pub gravity: Vector<Real>,
    pub parameters: IntegrationParameters,
    pub bodies: RigidBodySet,
    pub colliders: ColliderSet,
    pub joints: ImpulseJointSet,
    pub broad_phase: DefaultBroadPhase,
    pub narrow_phase: NarrowPhase,
    /// The bodies that were added, in order, with where they were.
    pub placed: Vec<(RigidBodyHandle, Vector<Real>)>,
}

impl Scene {
    /// The ground, whose surface is at y = 0.
    fn new() -> Self {
        let mut scene = Scene {
            gravity: vector![0.0, -9.81, 0.0],
            parameters: IntegrationParameters::default(),
            bodies: RigidBodySet::new(),
            colliders: ColliderSet::new(),
            joints: ImpulseJointSet::new(),
            broad_phase: DefaultBroadPhase::new(),
            narrow_phase: NarrowPhase::new(),
            placed: Vec::new(),
        };
        let ground = scene.bodies.insert(RigidBodyBuilder::fixed().translation(vector![0.0, -0.5, 0.0]));
        scene.colliders.insert_with_parent(ColliderBuilder::cuboid(50.0, 0.5, 50.0), ground, &mut scene.bodies);
        scene
    }

    fn add(&mut self, at: Isometry<Real>, collider: ColliderBuilder) -> RigidBodyHandle {
        let handle = self.bodies.insert(RigidBodyBuilder::dynamic().position(at).can_sleep(false));
        self.colliders.insert_with_parent(collider, handle, &mut self.bodies);
        self.placed.push((handle, at.translation.vector));
        handle
    }

    /// A cube of 1 m, the one of that number from the ground: 1 mm above the one below it and 2 cm beside it, to the right and to the left in
    /// turns.
    fn cube(&mut self, level: u16, mass: Real) {
        let side = if level % 2 == 0 { 0.01 } else { -0.01 };
        let at = Isometry::translation(side, 0.5 + 1.001 * Real::from(level), 0.0);
        self.add(at, ColliderBuilder::cuboid(0.5, 0.5, 0.5).mass(mass).friction(0.5));
    }

    /// How far sideways the body is that moved most, m.
    pub fn drift(&self) -> f64 {
        let moved = self.placed.iter().map(|(handle, at)| (self.bodies[*handle].translation() - at).xz().norm());
        f64::from(moved.fold(0.0, Real::max))
    }

    /// The largest distance between the anchors of a joint, m.
    pub fn joint_error(&self) -> f64 {
        let apart = self.joints.iter().map(|(_, joint)| {
            let first = self.bodies[joint.body1].position() * joint.data.local_anchor1();
            let second = self.bodies[joint.body2].position() * joint.data.local_anchor2();
            (second - first).norm()
        });
        f64::from(apart.fold(0.0, Real::max))
    }
}

/// Cubes of 1 kg on each other.
pub fn tall_stack(height: u16) -> Scene {
    let mut scene = Scene::new();
    for level in 0..height {
        scene.cube(level, 1.0);
    }
    scene
}

/// Five cubes of 1 kg, and one of `mass` kg on top of them.
pub fn heavy_on_light(mass: Real) -> Scene {
    let mut scene = tall_stack(5);
    scene.cube(5, mass);
    scene
}

/// A chain of ten links of 1 kg that swings from a post, 30° from the vertical, with a ball of `mass` kg at its end.
pub fn chain_with_weight(mass: Real) -> Scene {
    const LINK: Real = 0.5;
    let mut scene = Scene::new();
    let (post, turn) = (vector![0.0, 12.0, 0.0], vector![0.0, 0.0, std::f32::consts::FRAC_PI_6]);
    let down = Rotation::new(turn) * vector![0.0, -LINK, 0.0];
    let mut above = scene.bodies.insert(RigidBodyBuilder::fixed().translation(post).rotation(turn));
    let mut anchor = point![0.0, 0.0, 0.0];
    for link in 0..=10u8 {
        let (shape, mass) = match link {
            10 => (ColliderBuilder::ball(0.4 * LINK), mass),
            _ => (ColliderBuilder::capsule_y(0.3 * LINK, 0.05), 1.0),
        };
        let at = Isometry::new(post + down * (Real::from(link) + 0.5), turn);
        let body = scene.add(at, shape.mass(mass));
        let joint = SphericalJointBuilder::new().local_anchor1(anchor).local_anchor2(point![0.0, 0.5 * LINK, 0.0]);
        scene.joints.insert(above, body, joint, true);
        (above, anchor) = (body, point![0.0, -0.5 * LINK, 0.0]);
    }
    scene
}
