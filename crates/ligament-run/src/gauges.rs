//! Message about the rigid motions of a body that supports and loads leave free.

use ligament::Body;
use ligament_analysis::Component;
use ligament_analysis::gauges::{FreeBody, FreeMotion};

/// Message about the free rigid motions, the points fixed instead, and the equilibrium of the loads without these; `closing`: whether faces
/// of cracks may carry loads.
pub fn words(free: &FreeBody, body: &dyn Body, closing: bool) -> String {
    let what = if free.is_whole {
        "the body".to_owned()
    } else {
        let first = body.label(free.first);
        format!("{} points (around {first})", free.points)
    };
    let motions: Vec<&str> = free.motions.iter().map(|it| motion(it.component)).collect();
    let gauges = free.gauges.iter();
    let gauges: Vec<String> = gauges
        .map(|&(point, component)| format!("{} of {}", component.name(), body.place(point)))
        .collect();
    let loads = if free.is_balanced() {
        "this changes nothing, because the loads balance".to_owned()
    } else {
        let loads: Vec<String> = (free.motions.iter())
            .filter(|it| !it.is_balanced())
            .map(load)
            .collect();
        let loads = loads.join(", ");
        if closing && !free.is_whole {
            format!("crack faces that close must carry the loads ({loads})")
        } else {
            format!(
                "the loads do NOT balance ({loads}), so there is no equilibrium: add a support, or balance the loads"
            )
        }
    };
    format!(
        "the supports leave {what} free in {}; fixed automatically: {}; {loads}",
        motions.join(", "),
        gauges.join(", ")
    )
}

fn motion(component: Component) -> &'static str {
    match component {
        Component::X => "translation along x",
        Component::Y => "translation along y",
        Component::Z => "translation along z",
        Component::Rotation => "rotation",
        Component::RotationX => "rotation about x",
        Component::RotationY => "rotation about y",
        Component::RotationZ => "rotation about z",
    }
}

fn load(motion: &FreeMotion) -> String {
    match motion.component {
        Component::X | Component::Y | Component::Z => {
            format!("along {} {:.3e} N", motion.component.name(), motion.load)
        }
        Component::Rotation => format!("moment {:.3e} N m", motion.load),
        Component::RotationX => format!("moment about x {:.3e} N m", motion.load),
        Component::RotationY => format!("moment about y {:.3e} N m", motion.load),
        Component::RotationZ => format!("moment about z {:.3e} N m", motion.load),
    }
}
