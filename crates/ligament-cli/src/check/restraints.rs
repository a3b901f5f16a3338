//! Report of `ligament check` on supports, and on springs and platens of loads.

use std::io;

use ligament::setup::{Load, Setup, Support};

use ligament_output::quantity::quantity;

use super::report::Report;

/// Writes the fixed components and springs of each support, and the loads through springs or a platen.
pub(super) fn write(report: &mut Report<'_>, setup: &Setup) -> io::Result<()> {
    for (index, support) in setup.supports.iter().enumerate() {
        let name = format!("{} holds", support.name(index));
        report.entry(
            &name,
            of_support(support, setup.body.dimensions()).join(", "),
        )?;
    }
    for load in setup.loads.iter().filter(|it| it.is_restraint()) {
        report.entry(&format!("{} acts", load.name), of_load(load).join(", "))?;
    }
    Ok(())
}

fn of_support(support: &Support, dimensions: usize) -> Vec<String> {
    let mut words: Vec<String> = (support.components())
        .map(|it| it.name().to_owned())
        .collect();
    for (component, total) in support.stiffness.along_axes().components() {
        let unit = if component.is_rotation() {
            "N m/rad"
        } else {
            "N/m"
        };
        words.push(format!(
            "{} by springs of {}",
            component.name(),
            quantity(total, unit)
        ));
    }
    if let Some(normal) = support.restrained_normal() {
        let spring = support.stiffness.normal;
        let spring = spring.map(|total| format!(" by springs of {}", quantity(total, "N/m")));
        let normal: Vec<String> = normal[..dimensions].iter().map(f64::to_string).collect();
        let normal = normal.join(", ");
        words.push(format!("along ({normal}){}", spring.unwrap_or_default()));
    }
    words
}

fn of_load(load: &Load) -> Vec<String> {
    let springs = load.stiffness;
    let springs = springs.map(|total| format!("through springs of {}", quantity(total, "N/m")));
    let platen = load
        .tilts
        .then(|| "by a rigid platen that may tilt".to_owned());
    springs.into_iter().chain(platen).collect()
}
