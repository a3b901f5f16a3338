//! Images of a case: turned, mirrored, shifted, and in other units.

use verification::numbers::Random;

/// An image of the plane, x -> L x + shift with an orthogonal L, in units of its own.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Image {
    pub(crate) linear: [[f64; 2]; 2],
    /// Shift after the turn, in lengths before the change of units.
    pub(crate) shift: [f64; 2],
    /// New units of length in an old one.
    pub(crate) length: f64,
    /// New units of force in an old one.
    pub(crate) force: f64,
}

impl Image {
    pub(crate) const SAME: Self = Self {
        linear: [[1.0, 0.0], [0.0, 1.0]],
        shift: [0.0; 2],
        length: 1.0,
        force: 1.0,
    };

    /// The seven turns and mirror images of a square other than itself.
    pub(crate) fn of_square() -> Vec<Self> {
        let turns = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        let of = |[c, s]: [f64; 2], mirror: f64| Self {
            linear: [[c, -s * mirror], [s, c * mirror]],
            ..Self::SAME
        };
        let all = [1.0, -1.0].map(|mirror| turns.map(|turn| of(turn, mirror)));
        all.into_iter().flatten().skip(1).collect()
    }

    /// A turn by any angle, mirrored or not.
    pub(crate) fn any(random: &mut Random) -> Self {
        let (s, c) = (std::f64::consts::PI * random.uniform()).sin_cos();
        let mirror = random.uniform().signum();
        Self {
            linear: [[c, -s * mirror], [s, c * mirror]],
            ..Self::SAME
        }
    }

    /// A shift.
    pub(crate) fn by(shift: [f64; 2]) -> Self {
        Self {
            shift,
            ..Self::SAME
        }
    }

    /// Other units of length and force.
    pub(crate) fn units(length: f64, force: f64) -> Self {
        Self {
            length,
            force,
            ..Self::SAME
        }
    }

    /// A direction, or components without a unit.
    pub(crate) fn turned(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        // Zeros stay zeros: a component that is not there is not loaded.
        self.linear.map(|[a, b]| a * x + b * y)
    }

    /// A position.
    pub(crate) fn place(&self, position: [f64; 2]) -> [f64; 2] {
        let turned = self.turned(position);
        [0, 1].map(|axis| self.length * (turned[axis] + self.shift[axis]))
    }

    /// 1, or -1 of a mirror image: what becomes of a rotation.
    pub(crate) fn sense(&self) -> f64 {
        let [[a, b], [c, d]] = self.linear;
        (a * d - b * c).round()
    }

    /// Displacements and the rotation of a point.
    pub(crate) fn motion(&self, [x, y, rotation]: [f64; 3]) -> [f64; 3] {
        let [x, y] = self.turned([x, y]).map(|it| self.length * it);
        [x, y, self.sense() * rotation]
    }

    /// Forces and a moment, whose arms are the same.
    pub(crate) fn load(&self, [x, y, moment]: [f64; 3]) -> [f64; 3] {
        let [x, y] = self.turned([x, y]).map(|it| self.force * it);
        [x, y, self.sense() * self.energy() * moment]
    }

    /// New units of stress in an old one.
    pub(crate) fn stress(&self) -> f64 {
        self.force / (self.length * self.length)
    }

    /// New units of energy in an old one.
    pub(crate) fn energy(&self) -> f64 {
        self.force * self.length
    }

    /// Whether axes stay axes.
    pub(crate) fn keeps_axes(&self) -> bool {
        self.linear.as_flattened().contains(&0.0)
    }
}
