//! Messages about materials whose volumetric stiffness the cells carry.

use ligament_analysis::Message;
use ligament_model::BondSystem;
use ligament_model::material::{Isotropic, PoissonForm, VolumetricSplit};

use crate::setup::{Analysis, Horizon, Setup};

/// Horizon factors of [`EXCESS`].
const FACTORS: [f64; 3] = [2.2, 3.0, 4.0];

/// Energy that a crack through a notched plate took, over that at the Poisson's ratio of central forces, less 1, at kappa/mu and at each of
/// [`FACTORS`] (measured on an irregular mesh of 40 cells across, plane strain, nu = .3, .35, .4, .45, .49).
const EXCESS: [(f64, [f64; 3]); 5] = [
    (0.5, [-0.01, 0.02, -0.03]),
    (4.0 / 3.0, [0.16, 0.05, 0.0]),
    (3.0, [0.22, 0.10, 0.02]),
    (8.0, [0.30, 0.165, 0.03]),
    (48.0, [0.52, 0.25, 0.075]),
];

/// Smallest excess with a message.
const TOLD: f64 = 0.05;

/// Smallest shortening of the explicit step with a message.
const SHORTER: f64 = 1.5;

/// The split of a material in which cells carry a part of the stiffness.
pub(super) fn split(setup: &Setup, material: &Isotropic) -> Option<VolumetricSplit> {
    let by_cells = setup.law.options.poisson == Some(PoissonForm::Cells);
    let split = by_cells.then(|| VolumetricSplit::new(*material, setup.space()));
    split.filter(VolumetricSplit::is_split)
}

/// Message that brittle cracks take more than the fracture energy, because cells release theirs with the bonds.
pub(super) fn crack_excess(setup: &Setup, material: &Isotropic) -> Option<Message> {
    let split = split(setup, material)?;
    let mut criteria = setup.criteria.iter();
    criteria.find(|it| it.spends_fracture_energy() && !it.after.softens)?;
    let Horizon::Factor(factor) = setup.horizon else {
        return None;
    };
    let excess = excess(split.modulus / shear_modulus(material), factor);
    (excess > TOLD).then(|| {
        let text = format!(
            "Poisson's ratio {}: cells that die with the bonds of a crack release energy too, so that it takes about {:.0} % more than \
             the fracture energy at this horizon factor in a notched plate, and more where the body cannot contract",
            material.poisson,
            100.0 * excess
        );
        let advice = "take a horizon factor of 4, or a smaller fracture_energy by as much";
        Message::new("energy-of-cells", text).with_advice(advice)
    })
}

/// Message that explicit steps become short, because the pressure wave becomes fast.
pub(super) fn short_step(setup: &Setup, material: &Isotropic) -> Option<Message> {
    let split = split(setup, material)?;
    let is_explicit = matches!(&setup.analysis, Analysis::Motion(it) if it.is_explicit());
    // The square of the wave's speed is in proportion to lambda' + 2 mu, which is 3 mu without cells.
    let shorter = (1.0 + split.modulus / (3.0 * shear_modulus(material))).sqrt();
    (is_explicit && shorter > SHORTER).then(|| {
        let text = format!(
            "Poisson's ratio {}: explicit steps are about {shorter:.1} times shorter than at {:.4}, as the pressure wave is faster",
            material.poisson,
            Isotropic::central_force_poisson(setup.space())
        );
        let advice = "take `scheme = \"implicit\"` where waves do not matter";
        Message::new("short-step", text).with_advice(advice)
    })
}

/// Message about cells whose edges are so much longer than the horizons that bonds along them do not connect their corners.
pub(crate) fn without_edges<const D: usize>(system: &BondSystem<D>) -> Option<Message> {
    let cells = system.volumetric.as_ref()?.unconnected;
    (cells > 0).then(|| {
        let text = format!(
            "{cells} cells have too few bonds along their edges to carry their stiffness against changes of volume: the body is too soft there"
        );
        Message::new("cells-without-bonds", text).with_advice("take a greater horizon factor, or cells of even size")
    })
}

fn shear_modulus(material: &Isotropic) -> f64 {
    material.young / (2.0 * (1.0 + material.poisson))
}

/// Excess of the energy of a crack, between the measured values in proportion to the logarithm of kappa/mu and to the horizon factor.
fn excess(ratio: f64, factor: f64) -> f64 {
    let between = |low: f64, high: f64, at: f64| ((at - low) / (high - low)).clamp(0.0, 1.0);
    let of_factor = |values: &[f64; 3]| {
        let place = usize::from(factor > FACTORS[1]);
        let share = between(FACTORS[place], FACTORS[place + 1], factor);
        values[place] + share * (values[place + 1] - values[place])
    };
    let pairs = EXCESS.windows(2).map(|pair| (&pair[0], &pair[1]));
    let around = pairs.clone().find(|(_, upper)| ratio <= upper.0);
    let last = (&EXCESS[EXCESS.len() - 2], &EXCESS[EXCESS.len() - 1]);
    let (lower, upper) = around.unwrap_or(last);
    let share = between(lower.0.ln(), upper.0.ln(), ratio.ln());
    let [low, high] = [lower, upper].map(|it| of_factor(&it.1));
    low + share * (high - low)
}
