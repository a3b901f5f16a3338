//! Errors over orientation, and loci, as tables (CSV) and diagrams (SVG).

use std::f64::consts::TAU;

use ligament_output::csv::{Table, Value};
use ligament_output::folder::ResultFolder;
use ligament_post::yielding::PrincipalStretches;
use ligament_post::yielding::locus::{LocusPoint, bond_locus, principal_locus};

use super::request::SUMMARY;
use super::subject::{Strain, Subject};
use ligament_plot::plots::equal_scales::EqualScales;
use ligament_plot::plots::polar::PolarPlot;
use ligament_plot::plots::{Colour, Plot, Series};

/// Families of bonds under one criterion, or a combination of criteria.
#[derive(Debug, Clone)]
pub(super) struct Comparison {
    /// Name of the criterion.
    pub(super) criterion: String,
    /// Families that are compared.
    pub(super) subjects: Vec<Subject>,
}

/// Load paths in the tables, s_1 to s_2, as in the paper at F_c = 3 F_t.
pub(super) const PATHS: [PrincipalStretches; 12] = [
    PrincipalStretches::new(1.0, 1.0),
    PrincipalStretches::new(0.5, 1.0),
    PrincipalStretches::new(0.0, 1.0),
    PrincipalStretches::new(-1.0, 2.0),
    PrincipalStretches::new(-1.0, 1.0),
    PrincipalStretches::new(-3.0, 2.0),
    PrincipalStretches::new(-2.0, 1.0),
    PrincipalStretches::new(-3.0, 1.0),
    PrincipalStretches::new(-6.0, 1.0),
    PrincipalStretches::new(-1.0, 0.0),
    PrincipalStretches::new(-1.0, -0.5),
    PrincipalStretches::new(-1.0, -1.0),
];

/// Columns of the table of errors.
const ERRORS: &str = "criterion,family,bonds,s1,s2,error,worst_orientation_deg,printed_measure,printed_orientation_deg";

/// Columns of the table of loci.
const LOCUS: &str = "criterion,family,path_deg,s1,s2,s1_effective,s2_effective,bond_stretch,bond_sliding,decides,error";

/// Number of paths of a locus, one per degree.
const LOCUS_PATHS: u32 = 360;

/// Step of the orientations in the tables, as in the paper, degrees.
const ORIENTATION_STEP: f64 = 0.9;

/// Extent of a diagram of open loci, over the distance of the nearest point.
const WINDOW: f64 = 4.0;

/// Writes the tables `yield.csv`, `orientation.csv`, `locus.csv` and the diagrams of them.
pub(super) fn write(
    folder: ResultFolder,
    comparisons: &[Comparison],
    strains: &[Strain],
) -> anyhow::Result<()> {
    write_summary(&folder, comparisons)?;
    let mut orientation = Table::with_header(
        folder.file("orientation.csv"),
        "criterion,family,strain,orientation_deg,error",
    )?;
    let mut locus = Table::with_header(folder.file("locus.csv"), LOCUS)?;
    for comparison in comparisons {
        for strain in strains {
            if let Some(plot) = polar(comparison, strain, &mut orientation)? {
                let svg = plot.for_screen()?.to_svg(&plot.title);
                folder.write(&format!("{}.svg", plot.name), svg)?;
            }
        }
        for plot in loci(comparison, &mut locus)? {
            let svg = plot.for_screen()?.to_svg(&plot.plot.title);
            folder.write(&format!("{}.svg", plot.plot.name), svg)?;
        }
    }
    Ok(folder.finish()?)
}

fn write_summary(folder: &ResultFolder, comparisons: &[Comparison]) -> anyhow::Result<()> {
    let mut table = Table::with_header(folder.file(SUMMARY), ERRORS)?;
    for comparison in comparisons {
        for subject in &comparison.subjects {
            let family = subject.family();
            for path in PATHS {
                let Some(worst) = family.worst(path) else {
                    continue;
                };
                let on_locus = path.scaled(1.0 / family.theoretical_utilisation(path));
                let printed = subject.printed_measure(path)?;
                let of = |value: Option<f64>| Value::from(value.unwrap_or(f64::NAN));
                table.append(&[
                    comparison.criterion.as_str().into(),
                    subject.name.as_str().into(),
                    subject.size.into(),
                    on_locus.first.into(),
                    on_locus.second.into(),
                    worst.error.into(),
                    worst.orientation.to_degrees().into(),
                    of(printed.map(|it| it.error)),
                    of(printed.map(|it| it.orientation.to_degrees())),
                ])?;
            }
        }
    }
    Ok(())
}

/// Name of a diagram's file for a criterion, without `+` and spaces.
fn file_name(kind: &str, criterion: &str) -> String {
    format!("{kind}-{}", criterion.replace(['+', ' '], "-"))
}

/// Diagram of errors over the orientation; `None` where no bond yields.
fn polar(
    comparison: &Comparison,
    strain: &Strain,
    table: &mut Table,
) -> anyhow::Result<Option<PolarPlot>> {
    let criterion = &comparison.criterion;
    let mut series = Vec::new();
    for (subject, colour) in comparison.subjects.iter().zip(Colour::CYCLE.iter().cycle()) {
        let family = subject.family();
        let mut points = Vec::new();
        for k in 0..=400u32 {
            let degrees = ORIENTATION_STEP * f64::from(k);
            let orientation = degrees.to_radians();
            let Some(error) = family.error(strain.stretches, orientation) else {
                continue;
            };
            points.push([orientation, 100.0 * error]);
            if k <= 200 {
                table.append(&[
                    criterion.as_str().into(),
                    subject.name.as_str().into(),
                    strain.name.into(),
                    degrees.into(),
                    error.into(),
                ])?;
            }
        }
        series.push(Series::curve(&subject.name, *colour, points));
    }
    let plot = PolarPlot {
        name: file_name(&format!("error-{}", strain.name), criterion),
        title: format!("Error of first yield: {criterion}, {}", strain.words),
        radius: "error, %, over the orientation of the first principal axis".to_owned(),
        series,
    };
    let is_drawn = |series: &Series| series.points().iter().any(|it| it[1].is_finite());
    Ok(plot.series.iter().any(is_drawn).then_some(plot))
}

/// Appends a row for each point of the locus of a family.
fn append_locus(
    table: &mut Table,
    criterion: &str,
    subject: &Subject,
    points: &[LocusPoint],
) -> Result<(), ligament_output::Error> {
    for it in points {
        table.append(&[
            criterion.into(),
            subject.name.as_str().into(),
            it.path.to_degrees().into(),
            it.theoretical.first.into(),
            it.theoretical.second.into(),
            it.effective.first.into(),
            it.effective.second.into(),
            it.bond.stretch().into(),
            it.bond.shear().into(),
            subject.criterion_name(it.criterion).into(),
            it.error.into(),
        ])?;
    }
    Ok(())
}

/// Diagrams of loci in the planes of the principal stretches and of the bond's stretch and sliding.
fn loci(comparison: &Comparison, table: &mut Table) -> anyhow::Result<Vec<EqualScales>> {
    let criterion = &comparison.criterion;
    let (mut principal, mut bond) = (Vec::new(), Vec::new());
    let (mut theory, mut limits) = (Vec::new(), Vec::new());
    for (subject, colour) in comparison.subjects.iter().zip(Colour::CYCLE.iter().cycle()) {
        let family = subject.family();
        let points = principal_locus(&family, LOCUS_PATHS);
        append_locus(table, criterion, subject, &points)?;
        let effective = closed(&points, |it| it.effective);
        principal.push(Series::curve(&subject.name, *colour, effective));
        for (place, piece) in limits_by_criterion(&points).into_iter().enumerate() {
            let name = if place == 0 {
                subject.name.as_str()
            } else {
                ""
            };
            let mirrored = piece
                .iter()
                .map(|&[stretch, shear]| [stretch, -shear])
                .collect();
            bond.push(Series::curve(name, *colour, piece));
            bond.push(Series::curve("", *colour, mirrored));
        }
        if theory.is_empty() {
            theory = closed(&points, |it| it.theoretical);
            limits = bond_locus(&family, LOCUS_PATHS);
            limits.extend(limits.first().copied());
        }
    }
    let of_bond = "stretch and sliding of a bond";
    let mut plots = Vec::new();
    for (kind, title, axes, curves, dashes) in [
        (
            "locus",
            "principal stretches",
            ["s1", "s2"],
            principal,
            theory,
        ),
        ("bond", of_bond, ["s", "gamma"], bond, limits),
    ] {
        let Some(window) = window(&dashes) else {
            continue;
        };
        let mut series = vec![Series::curve("theory", Colour::Black, dashes)];
        series.extend(curves);
        let title = format!("First yield, {criterion}: {title}");
        let plot = Plot::new(file_name(kind, criterion), title, axes, series);
        plots.push(EqualScales { plot, window });
    }
    Ok(plots)
}

/// A locus as a closed curve around zero, interrupted where paths have no point.
fn closed(points: &[LocusPoint], strains: fn(&LocusPoint) -> PrincipalStretches) -> Vec<[f64; 2]> {
    let mut curve = Vec::new();
    let mut last: Option<f64> = None;
    let closing = points.first().map(|it| (it.path + TAU, it));
    for (path, it) in points.iter().map(|it| (it.path, it)).chain(closing) {
        if last.is_some_and(|last| path - last > 1.5 * TAU / f64::from(LOCUS_PATHS)) {
            curve.push([f64::NAN; 2]);
        }
        let at = strains(it);
        curve.push([at.first, at.second]);
        last = Some(path);
    }
    curve
}

/// Effective limits of a bond's stretch and sliding, in pieces of successive paths with the same deciding criterion.
fn limits_by_criterion(points: &[LocusPoint]) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<(usize, Vec<[f64; 2]>)> = Vec::new();
    for it in points {
        let scale = 1.0 + it.error;
        let point = [scale * it.bond.stretch(), scale * it.bond.shear()];
        match pieces.last_mut() {
            Some((criterion, piece)) if *criterion == it.criterion => piece.push(point),
            _ => pieces.push((it.criterion, vec![point])),
        }
    }
    pieces.into_iter().map(|(_, piece)| piece).collect()
}

/// Window of a diagram: all points not much farther than the nearest, with a margin.
fn window(points: &[[f64; 2]]) -> Option<[[f64; 2]; 2]> {
    let size = |it: &[f64; 2]| it[0].hypot(it[1]);
    let finite = || points.iter().filter(|it| size(it).is_finite());
    let nearest = finite().map(size).reduce(f64::min)?;
    let shown = || finite().filter(|it| size(it) <= WINDOW * nearest);
    let bound = |axis: usize, pick: fn(f64, f64) -> f64| {
        shown()
            .map(|it| it[axis])
            .chain([0.0])
            .reduce(pick)
            .unwrap_or(0.0)
    };
    let room = 0.8 * nearest;
    Some([
        [0, 1].map(|axis| bound(axis, f64::min) - room),
        [0, 1].map(|axis| bound(axis, f64::max) + room),
    ])
}
