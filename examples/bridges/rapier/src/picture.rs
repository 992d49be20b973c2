//! Scenes seen from the side, beside each other, as SVG.
use rapier3d::prelude::*;
use svg::Document;
use svg::node::element::{Group, Line, Polygon, Text};

use crate::scene::Scene;

/// One scene with what stands below it.
pub struct View<'a> {
    pub title: &'static str,
    pub scene: &'a Scene,
}

const WIDTH: f32 = 3.4;

/// The views from the left to the right; `height` m are seen.
pub fn draw(views: &[View<'_>], height: f32) -> Document {
    let width = WIDTH * views.len() as f32;
    let mut document = Document::new()
        .set("viewBox", (0.0, -height, width, height + 1.4))
        .set("width", 75.0 * width)
        .set("height", 75.0 * (height + 1.4))
        .set("font-family", "sans-serif")
        .set("font-size", 0.24);
    for (i, view) in views.iter().enumerate() {
        let middle = WIDTH * (i as f32 + 0.5);
        let mut group = Group::new().set("transform", format!("translate({middle} 0)"));
        for (index, (handle, _)) in view.scene.placed.iter().enumerate() {
            group = group.add(cube(&view.scene.bodies[*handle], index));
        }
        let half = WIDTH * 0.46;
        let ground = Line::new().set("x1", -half).set("x2", half).set("y1", 0.0).set("y2", 0.0);
        group = group.add(ground.set("stroke", "black").set("stroke-width", 0.04));
        for (line, text) in view.title.split(", ").enumerate() {
            group = group.add(Text::new(text).set("text-anchor", "middle").set("y", 0.4 + 0.3 * line as f32));
        }
        document = document.add(group);
    }
    document
}

/// The face of a cube of 1 m that looks at us.
fn cube(body: &RigidBody, index: usize) -> Polygon {
    let corner = |x: Real, y: Real| {
        let at = body.position() * point![x, y, 0.5];
        format!("{:.3},{:.3}", at.x, -at.y)
    };
    let corners = [corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)].join(" ");
    let colour = match (body.mass() > 10.0, index % 2) {
        (true, _) => "#c44e52",
        (false, 0) => "#8fb1d9",
        (false, _) => "#5b86bd",
    };
    Polygon::new()
        .set("points", corners)
        .set("fill", colour)
        .set("fill-opacity", 0.75)
        .set("stroke", "black")
        .set("stroke-width", 0.02)
}
