//! Critical stretch from the fracture energy G_c, the energy that separates a body in two halves.

/// Critical stretch for the fracture energy G_c (J/m^2), the opening modulus w of the law (Pa) and the bond horizon H (m):
///
/// s_0 = sqrt(G_c/(w H)).
///
/// Every bond that crosses the plane of the crack is stretched to s_0 and gives 1/2 k_n l s_0^2 V_A V_B. A bond of length l
/// crosses it where its first end lies within l |cos phi| of it, so that per area
///
/// G_c = t integral_0^H integral_0^(2 pi) 1/2 (l |cos phi|) (1/2 k_n l s_0^2) l dphi dl = s_0^2 t integral_0^H k_n l^3 dl,
///
/// and w = t/H integral k_n l^3 dl (the two-dimensional form of Silling and Askari 2005, eq. 26, for any k_n(l)). What shear stores
/// in those bonds comes on top. With [`Measure::Energy`](super::Measure::Energy) it is counted, and G_c holds for every
/// Poisson's ratio; with the plain stretch it holds where k_t = 0.
pub fn critical_stretch(fracture_energy: f64, opening_modulus: f64, horizon: f64) -> f64 {
    (fracture_energy / (opening_modulus * horizon)).sqrt()
}
