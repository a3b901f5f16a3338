//! Plots of an ensemble: quantiles of the curves, Weibull plots of the loads, and where fracture begins.

use ligament::units::Units;
use ligament_model::{BodyGrid, Canvas};
use ligament_output::vtu::Cell;
use ligament_plot::picture::maps::{MappedBody, Maps};
use ligament_plot::plots::{Colour, Plot, Series};
use ligament_post::statistics::{WeibullFit, plotting_position, quantile};

use super::collected::{CollectedSamples, NINETY_PERCENT, PROBABILITIES, Strengths};
use super::identity::Identity;

/// Largest number of circles of a Weibull plot; more samples are thinned out evenly.
const MOST_CIRCLES: usize = 1000;

/// Number of points of the bounds of a fitted line.
const POINTS_OF_BAND: usize = 41;

/// The plots of curves and loads.
pub(super) fn plots(
    title: &str,
    units: Units,
    identity: &Identity,
    collected: &CollectedSamples,
    strengths: &[Strengths],
) -> [Plot; 2] {
    [
        curves(title, units, identity, collected),
        weibull(title, units, strengths),
    ]
}

/// Quantiles of the load over the displacement.
fn curves(title: &str, units: Units, identity: &Identity, collected: &CollectedSamples) -> Plot {
    let displacements = identity.grid.displacements();
    let over = |load: &dyn Fn(usize) -> Option<f64>| -> Vec<[f64; 2]> {
        let places = displacements.iter().enumerate();
        places
            .filter_map(|(place, x)| Some([*x, load(place)?]))
            .collect()
    };
    let colours = [
        Colour::Sky,
        Colour::Blue,
        Colour::Black,
        Colour::Blue,
        Colour::Sky,
    ];
    let of_probability = |(probability, colour): (f64, Colour)| {
        let points = over(&|place| quantile(&collected.loads[place], probability));
        Series::curve(format!("{:.0} %", 100.0 * probability), colour, points)
    };
    let mut series: Vec<Series> = PROBABILITIES
        .into_iter()
        .zip(colours)
        .map(of_probability)
        .collect();
    let sound = over(&|place| identity.sound[place]);
    series.push(Series::dashes(
        "without random factors",
        Colour::Vermilion,
        sound,
    ));
    let axes = [
        format!("displacement, {}", units.displacement),
        format!("load, {}", units.force),
    ];
    let n = collected.rows.len();
    Plot::new(
        "curves",
        format!("{title}: quantiles of {n} samples"),
        [&axes[0], &axes[1]],
        series,
    )
}

/// Weibull plot of the loads at the first breakage and at the peak: straight where the distribution is Weibull's.
fn weibull(title: &str, units: Units, strengths: &[Strengths]) -> Plot {
    let mut series = Vec::new();
    let drawn = strengths.iter().filter(|it| it.name != "first_peak");
    for (strengths, colour) in drawn.zip([Colour::Vermilion, Colour::Blue]) {
        let circles = points(&strengths.loads);
        series.push(Series::circles(strengths.words, colour, circles));
        if let Some(fit) = &strengths.fit {
            let label = format!("m = {:.2}", fit.modulus);
            let [line, below, above] = band(fit, strengths.loads.len());
            series.push(Series::curve(label, colour, line));
            series.push(Series::dashes("90 %", colour, below));
            series.push(Series::dashes("", colour, above));
        }
    }
    let load = format!("ln(load / 1 {})", units.force);
    Plot::new(
        "weibull",
        format!("{title}: Weibull plot"),
        [&load, "ln(-ln(1 - F))"],
        series,
    )
}

/// Loads in ascending order at their plotting positions.
fn points(loads: &[f64]) -> Vec<[f64; 2]> {
    let mut ascending: Vec<f64> = loads.iter().copied().filter(|it| *it > 0.0).collect();
    ascending.sort_by(f64::total_cmp);
    let n = ascending.len();
    let every = n.div_ceil(MOST_CIRCLES).max(1);
    let numbered = ascending.iter().enumerate().step_by(every);
    numbered
        .map(|(place, load)| [load.ln(), reduced(plotting_position(place + 1, n))])
        .collect()
}

/// The fitted line and its bounds over the probabilities of n samples.
fn band(fit: &WeibullFit, n: usize) -> [Vec<[f64; 2]>; 3] {
    let [low, high] = [1, n].map(|rank| reduced(plotting_position(rank, n)));
    let places = (0..POINTS_OF_BAND).map(|it| {
        let share = it as f64 / (POINTS_OF_BAND - 1) as f64;
        let w = low + share * (high - low);
        (w, -(-w.exp()).exp_m1())
    });
    let places: Vec<(f64, f64)> = places.collect();
    let line = |load: &dyn Fn(f64) -> f64| {
        let points = places
            .iter()
            .map(|&(w, probability)| [load(probability).ln(), w]);
        points.collect()
    };
    [
        line(&|it| fit.quantile(it)),
        line(&|it| fit.quantile_within(it, NINETY_PERCENT)[0]),
        line(&|it| fit.quantile_within(it, NINETY_PERCENT)[1]),
    ]
}

/// Ordinate ln(-ln(1 - F)) of a probability F.
fn reduced(probability: f64) -> f64 {
    (-(-probability).ln_1p()).ln()
}

/// Maps of a body in the plane: where fracture begins, and where the body is damaged in the end.
pub(super) fn maps(title: &str, grid: &BodyGrid, collected: &CollectedSamples) -> Vec<Maps> {
    let [first, damaged] = collected.shares();
    let map = |name: &str, words: &str, quantity: &str, values: Vec<f64>| {
        Some(Maps {
            name: name.to_owned(),
            title: format!("{title}: {words}"),
            quantity: quantity.to_owned(),
            unit: "-",
            bodies: vec![mapped_body(grid, values)?],
            columns: 1,
            are_modes: false,
        })
    };
    let maps = [
        map(
            "first-break",
            "where fracture begins",
            "share of samples",
            first,
        ),
        map(
            "damaged",
            "where bonds are broken",
            "share of samples",
            damaged,
        ),
    ];
    maps.into_iter().flatten().collect()
}

/// The body with values of its points (n_points); none for a solid, or without values.
fn mapped_body(grid: &BodyGrid, values: Vec<f64>) -> Option<MappedBody> {
    let n_points = grid.positions.len();
    if values.len() != n_points {
        return None;
    }
    let at_rest = vec![[0.0; 2]; n_points];
    match &grid.canvas {
        Canvas::Between(cells) => {
            let nodes = grid.positions.iter().map(|[x, y, _]| [*x, *y]).collect();
            let cells = cells.iter().map(|it| Cell::from(*it)).collect();
            Some(MappedBody::from_mesh("", nodes, cells, at_rest, values))
        }
        Canvas::Around(squares) => Some(MappedBody::from_squares("", squares, &at_rest, values)),
        Canvas::Solid(_) | Canvas::Boxes(_) => None,
    }
}
