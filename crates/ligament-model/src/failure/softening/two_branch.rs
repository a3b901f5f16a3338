//! A fall of the force in two straight lines, as concrete has it (Petersson 1981).

use super::law::{Fall, Law, Parameter};
use super::softened::Softened;

/// Force over that at the limit where the second line begins.
const KINK: f64 = 1.0 / 3.0;

/// Twice the energy of the whole life over the energy at the limit, for an end of one.
const ENERGY: f64 = 5.0 / 9.0;

/// The force falls in a straight line to a third, and in a flatter one to zero at r = e_u/e_0, the key `end`.
///
/// Petersson's stress over the opening w of a crack has the corners (0, f_t), (0.8 G/f_t, f_t/3) and (3.6 G/f_t, 0). A bond that opens by
/// w beside its elastic deformation has e/e_0 = mu + w/w_0, with G = g f_t w_0: the corners are kappa = 1, 1/3 + 0.8 g and r = 3.6 g.
/// The whole life takes 2 g = 5 r/9 times the energy at the limit, exactly; the first line falls where r > 3.
pub const LAW: Law = Law {
    word: "two-branch",
    words: "Its force falls in two straight lines, to a third and then to zero (Petersson's, of concrete).",
    source: "Petersson 1981",
    force: "force falls to a third and then to zero, in two straight lines (Petersson)",
    parameter: Some(Parameter::end(3.0, 5.0 / 3.0)),
    softens: true,
    sliding_because: None,
    fall: Fall::Formula {
        at,
        end: |end| end,
        total: |end| ENERGY * end,
        for_energy: |energy| energy / ENERGY,
    },
};

/// mu = 1 - (1 - 1/3)(kappa - 1)/(kappa_1 - 1) up to kappa_1 = 1/3 + 2 r/9, then (r - kappa)/(r - kappa_1)/3; omega = mu/kappa; what is gone
/// is twice the area under mu less that of unloading, mu kappa.
fn at(end: f64, kappa: f64) -> Softened {
    let kink = KINK + 2.0 / 9.0 * end;
    let (force, taken) = if kappa < kink {
        let force = 1.0 - (1.0 - KINK) * (kappa - 1.0) / (kink - 1.0);
        (force, 1.0 + (1.0 + force) * (kappa - 1.0))
    } else {
        let force = (KINK * (end - kappa) / (end - kink)).max(0.0);
        let first = 1.0 + (1.0 + KINK) * (kink - 1.0);
        (force, first + (KINK + force) * (kappa - kink))
    };
    Softened {
        force,
        secant: force / kappa,
        dissipated: taken - force * kappa,
    }
}
