//! Energy release rate of a growing crack, from two equilibrium states.
//!
//! Between two states with crack areas A < A', displacements u, u' and forces F, F' of the load:
//!
//! - from the compliance C = u/F, G = F F' (C' - C)/(2 (A' - A)) = (F u' - F' u)/(2 (A' - A)): the area between the two straight lines
//!   through the origin and the chord of the curve over the new area, in the limit G = F^2/2 dC/dA (Irwin and Kies 1954). Valid
//!   where one proportional load acts alone and an unloaded body has no forces; sudden drops between the states count
//!   as their chord.
//! - from the energies, G = (W' - W)/(A' - A) with the energy W released by breakages, for any loads. Sudden growth in a load
//!   step at constant displacement shows its larger rate here.
//! - dissipated energy over the new area: the fracture energy that the criterion actually spends. It is smaller than the
//!   released energy where a crack runs faster than the load.
//!
//! Cracks grow by one face between two points at a time, so that rates between successive records scatter: the earlier state is the
//! last one whose crack is smaller by a given least area.

/// Data of a state from which energy release rates are computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GrowthState {
    /// Area of the cracks, their length times the thickness of the body, m^2.
    pub area: f64,
    /// Displacement of the control load, m.
    pub displacement: f64,
    /// Force of the control load, N.
    pub reaction: f64,
    /// Energy released by breakages so far, J.
    pub released_energy: f64,
    /// Energy dissipated by bonds so far, J.
    pub dissipated_energy: f64,
}

/// Energies over the area by which a crack grew, J/m^2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReleaseRates {
    /// Energy release rate from the compliance.
    pub by_compliance: f64,
    /// Energy release rate from the energies.
    pub by_energy: f64,
    /// Energy dissipated by bonds.
    pub dissipated: f64,
}

/// Rates at each of some states in order, over crack growth by at least `least` (m^2); none where the crack has not grown that far.
pub fn release_rates(states: &[GrowthState], least: f64) -> Vec<Option<ReleaseRates>> {
    let rates = |(place, now): (usize, &GrowthState)| {
        let mut before = states[..place].iter().rev();
        let before = before.find(|it| now.area - it.area >= least)?;
        Some(now.rates_since(before))
    };
    states.iter().enumerate().map(rates).collect()
}

impl GrowthState {
    fn rates_since(&self, before: &Self) -> ReleaseRates {
        let new = self.area - before.area;
        let lines = before.reaction * self.displacement - self.reaction * before.displacement;
        ReleaseRates {
            by_compliance: 0.5 * lines / new,
            by_energy: (self.released_energy - before.released_energy) / new,
            dissipated: (self.dissipated_energy - before.dissipated_energy) / new,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A double cantilever beam of two arms of height h and thickness b, opened by u at their ends: F = 3 E I u/(2 a^3), I = b h^3/12, so
    /// that G = 9 E I u^2/(4 b a^4), with the arms as cantilevers. Rates from differences lie between those at the two
    /// crack lengths.
    #[test]
    fn a_double_cantilever_beam_releases_what_its_compliance_says() {
        let (modulus, height, thickness, opening) = (70e9_f64, 3e-3_f64, 20e-3_f64, 1e-4_f64);
        let bending = modulus * thickness * height.powi(3) / 12.0;
        let force = |a: f64| 1.5 * bending * opening / a.powi(3);
        let rate = |a: f64| 9.0 * bending * opening * opening / (4.0 * thickness * a.powi(4));
        let lengths = [50e-3, 50.5e-3, 51e-3, 51.5e-3];
        let stored = |a: f64| 0.5 * force(a) * opening;
        let states = lengths.map(|a| GrowthState {
            area: a * thickness,
            displacement: opening,
            reaction: force(a),
            released_energy: stored(lengths[0]) - stored(a),
            dissipated_energy: 0.0,
        });
        let found = release_rates(&states, 0.9e-3 * thickness);
        assert_eq!((found[0], found[1]), (None, None));
        for (place, found) in found.iter().enumerate().skip(2) {
            let found = found.as_ref().map(|it| [it.by_compliance, it.by_energy]);
            let [compliance, energy] = found.unwrap_or_default();
            assert!((compliance / energy - 1.0).abs() < 1e-9);
            assert!(compliance < rate(lengths[place - 2]) && compliance > rate(lengths[place]));
        }
    }
}
