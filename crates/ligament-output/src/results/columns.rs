//! The columns of the tables of a run: names, units, meanings, and their values from a record.
//!
//! Writers of tables, arrays in Python, units in pictures and in the report page, and `docs/columns.md` follow from these rows. Words in
//! capitals in a name are replaced by names of a run.

use std::time::Duration;

use ligament_analysis::contact::{ContactReading, RigidState};
use ligament_analysis::costs::Costs;
use ligament_analysis::history::{BreakRecord, ContactAtRest, InMotion, StepRecord};
use ligament_analysis::probe::{PointField, motion_unit};
use ligament_model::stress::tip_field::TipQuantity;

use crate::csv::Value;

/// A column of a table.
#[derive(Debug, Clone, Copy)]
pub struct Column {
    /// Name in the header of the table.
    pub name: &'static str,
    /// SI unit; `-` for a number without a unit, empty for a count or a word.
    pub unit: &'static str,
    /// Whether the tables of a body in the plane have the column, and whether the tables of a solid have it.
    spaces: [bool; 2],
    /// Meaning, as on the page of columns.
    pub meaning: &'static str,
}

/// A column with the function that returns its value from a record.
pub type Reading<R, V = Value<'static>> = (Column, fn(&R) -> V);

const ANY: [bool; 2] = [true, true];
const PLANE: [bool; 2] = [true, false];
const SOLID: [bool; 2] = [false, true];

macro_rules! columns {
    ($doc:literal $table:ident: $($name:literal $unit:literal $spaces:ident $meaning:literal;)+) => {
        #[doc = $doc]
        pub const $table: &[Column] =
            &[$(Column { name: $name, unit: $unit, spaces: $spaces, meaning: $meaning }),+];
    };
    ($doc:literal $table:ident of $record:ty, $value:ty: $($name:literal $unit:literal $spaces:ident $meaning:literal => $read:expr;)+) => {
        #[doc = $doc]
        pub const $table: &[Reading<$record, $value>] =
            &[$((Column { name: $name, unit: $unit, spaces: $spaces, meaning: $meaning }, $read)),+];
    };
}

columns! { "Columns of every history."
    HISTORY of StepRecord, Value<'static>:
    "step" "" ANY "number of the load step or event of the exact path" => |it| it.step.into();
    "load_factor" "-" ANY
        "factor of all loads; with [stages](programmes.md) the share of the stage that is over; in a motion the time" => |it| it.load_factor.into();
    "displacement" "m" ANY
        "displacement of the load, in its direction; with a couple rad (the mean [turn of the loaded points](loads.md#couples)), with a \
         pressure m^3, with a temperature alone K" => |it| it.displacement.into();
    "reaction" "N" ANY
        "force of the load, in its direction; a couple N m, a pressure Pa, with a temperature alone J/K" => |it| it.reaction.into();
    "stored_energy" "J" ANY "energy stored in the bonds" => |it| it.stored_energy.into();
    "released_energy" "J" ANY
        "energy that all breakages so far took out of the body, whatever became of it: cracks and motion" => |it| it.released_energy.into();
    "broken_bonds" "" ANY "bonds broken so far" => |it| it.broken_bonds.into();
    "external_work" "J" ANY "work done so far by supports and loads" => |it| it.external_work.into();
    "energy_error" "-" ANY "(external work - stored - released energy)/external work: 0 but for rounding; in a [motion](motion.md) all energies of its ledger count" => |it| it.energy_error().into();
    "broken_in_step" "" ANY
        "bonds broken in this step; on the exact path those about to break, which are not yet among `broken_bonds`"
        => |it| it.broken_in_step.into();
    "largest_ratio" "-" ANY
        "largest utilisation of an intact bond: measure over limit, s/s_0 for most criteria" => |it| it.largest_ratio.into();
    "rounds" "" ANY "rounds of breaking in this step" => |it| it.rounds.into();
    "solves" "" ANY "solutions of the equations in this step" => |it| it.solves.into();
    "fragments" "" ANY "parts into which the body fell" => |it| it.fragments.into();
    "at_rest" "" ANY
        "1 if no bond was left to break; 0 in the last row of a run that ended before. That row is the last equilibrium on the way of a \
         body that was breaking, under a load that it does not carry: after a collapse its displacements may be as large as the body, \
         and neither they nor the energies beside them are those of a test; of a motion it is the first that is not to be trusted" => |it| usize::from(it.at_rest).into();
    "negative_eigenvalues" "" ANY
        "negative eigenvalues of the stiffness; 0 where it is positive definite" => |it| it.negative_eigenvalues.into();
    "dissipated_energy" "J" ANY
        "energy that the laws of the bonds took for good: of a brittle bond what it stored at its limit"
        => |it| it.dissipated_energy.into();
}

columns! { "Columns of a history whose loading has stages; one factor for each load."
    STAGES:
    "stage" "" ANY "name of the stage, where a loading has stages";
    "LOAD_factor" "-" ANY "factor of a load, or of `temperature`, where a loading has stages";
}

columns! { "The column of a history of a body whose crack faces close."
    CLOSING of StepRecord, Value<'static>:
    "closed_pairs" "" ANY
        "pairs of points across cracks that carry pressure; with `model.closing = true` alone" => |it| it.closed_pairs.into();
}

columns! { "Columns of a history of a body at rest with friction or contact between surfaces."
    CONTACT of ContactAtRest, Value<'static>:
    "contact_energy" "J" ANY "energy stored in contacts between surfaces" => |it| it.contact_energy.into();
    "friction_energy" "J" ANY "energy that friction and the birth and end of contacts took so far" => |it| it.friction_energy.into();
}

columns! { "Columns of a history of a motion in time, by the time and what is recorded there."
    MOTION of (f64, InMotion), Value<'static>:
    "time" "s" ANY "time of a [motion](motion.md), the same as `load_factor`" => |it| it.0.into();
    "time_steps" "" ANY "time steps so far" => |it| it.1.time_steps.into();
    "kinetic_energy" "J" ANY "kinetic energy of displacements and rotations" => |it| it.1.kinetic_energy.into();
    "damping_energy" "J" ANY "energy that damping and quiet edges took so far" => |it| it.1.damping_energy.into();
    "contact_energy" "J" ANY "energy stored in contacts between surfaces" => |it| it.1.contact_energy.into();
    "friction_energy" "J" ANY "energy that friction and the birth and end of contacts took so far" => |it| it.1.friction_energy.into();
    "initial_energy" "J" ANY "energy of the body at time zero; below zero by the kinetic energy of half a step where forces begin suddenly" => |it| it.1.initial_energy.into();
}

columns! { "Columns of a history for each group with supports or loads."
    GROUPS:
    "GROUP.force_x" "N" ANY
        "force along x that a support or a load exerts on the body: its group, or `support-N` for the N-th support where that is a \
         `box` or `at`, or its group begins with `=`, `+`, `-` or `@`, as a formula of a spreadsheet does (so with `load-N`); \
         where groups have points in common, a reaction counts once, for the first that prescribes the motion";
    "GROUP.force_y" "N" ANY "force along y";
    "GROUP.force_z" "N" SOLID "force along z, of a solid";
    "GROUP.moment" "N m" PLANE "sum of the moments on its points, in the plane";
    "GROUP.moment_x" "N m" SOLID "of a solid, about x: sum of the moments on its points, without those of its forces";
    "GROUP.moment_y" "N m" SOLID "about y";
    "GROUP.moment_z" "N m" SOLID "about z";
}

columns! { "Columns of a history for each contact between surfaces: that of a `[[rigid]]` body has its name, one `between` two groups theirs, \
    `a-b`, and one between all parts is `parts`."
    CONTACTS of ContactReading, Value<'static>:
    "CONTACT.force_x" "N" ANY
        "force along x, pressing and friction, on the first group of a [contact](contact.md), of all parts on that with the smallest number \
         of a node or cell, or by a rigid body on the body" => |it| it.force(0).into();
    "CONTACT.force_y" "N" ANY "force along y" => |it| it.force(1).into();
    "CONTACT.force_z" "N" SOLID "force along z, of a solid" => |it| it.force(2).into();
    "CONTACT.pressing" "N" ANY "sum of the sizes of the pressing forces in all its places" => |it| it.pressing.into();
    "CONTACT.area" "m^2" ANY "area in contact" => |it| it.area.into();
    "CONTACT.penetration" "m" ANY "deepest overlap that causes a force" => |it| it.penetration.into();
}

columns! { "Columns of a history for each rigid body."
    RIGID_BODIES of RigidState, Value<'static>:
    "RIGID.displacement_x" "m" ANY "displacement of a [rigid body](contact.md) along x" => |it| it.displacement[0].into();
    "RIGID.displacement_y" "m" ANY "displacement along y" => |it| it.displacement[1].into();
    "RIGID.displacement_z" "m" SOLID "displacement along z, of a solid" => |it| it.displacement[2].into();
    "RIGID.rotation" "rad" PLANE "its angle, in the plane; 0 without an `inertia`" => |it| it.rotation[2].into();
    "RIGID.velocity_x" "m/s" ANY "its velocity along x" => |it| it.velocity[0].into();
    "RIGID.velocity_y" "m/s" ANY "velocity along y" => |it| it.velocity[1].into();
    "RIGID.velocity_z" "m/s" SOLID "velocity along z, of a solid" => |it| it.velocity[2].into();
    "RIGID.angular_velocity" "rad/s" PLANE "its angular velocity, in the plane" => |it| it.angular_velocity[2].into();
    "RIGID.angular_velocity_x" "rad/s" SOLID "of a solid, about x" => |it| it.angular_velocity[0].into();
    "RIGID.angular_velocity_y" "rad/s" SOLID "about y" => |it| it.angular_velocity[1].into();
    "RIGID.angular_velocity_z" "rad/s" SOLID "about z" => |it| it.angular_velocity[2].into();
}

columns! { "Columns of a history for each probe."
    PROBES:
    "PROBE" "" ANY
        "reading of a probe: a motion m or rad, a stress Pa ([not that of the continuum](results.md#stresses) at single points of a \
         mesh), an energy density J/m^3, a force N, a moment N m, an energy release rate J/m^2, a stress intensity factor Pa m^0.5";
}

columns! { "First columns of the table of broken bonds."
    BREAKS of BreakRecord, Value<'static>:
    "order" "" ANY "place in the order of all breakages, from 1" => |it| it.order.into();
    "step" "" ANY "load step or event" => |it| it.step.into();
    "round" "" ANY "round of breaking in it, from 1; in a motion the time step" => |it| it.round.into();
    "load_factor" "-" ANY "load factor just before" => |it| it.load_factor.into();
    "displacement" "m" ANY "displacement of the load just before" => |it| it.displacement.into();
    "reaction" "N" ANY "force of the load just before" => |it| it.reaction.into();
}

columns! { "Columns of the ends of a bond: nodes of a mesh, cells of a lattice, or points of a table."
    ENDS:
    "node_a" "" ANY "tag of one end, on a mesh";
    "node_b" "" ANY "tag of the other end, on a mesh";
    "cell_a" "" ANY "number of the cell at one end, on a lattice, counted row by row from 1";
    "cell_b" "" ANY "number of the cell at the other end, on a lattice";
    "point_a" "" ANY "number of the point at one end, of a table of points, counted from 0";
    "point_b" "" ANY "number of the point at the other end, of a table of points";
}

columns! { "Columns of the failure of a bond."
    FAILURE:
    "utilisation" "-" ANY "measure over limit when the bond broke";
    "criterion" "" ANY "criterion by which the bond failed; a second one of the same kind ends in `-2`";
}

columns! { "Columns of the deformation of a broken bond."
    STRAINS:
    "stretch" "-" ANY "stretch of the bond then";
    "shear" "-" ANY "shear angle of the bond then";
    "strain_xx" "-" ANY "with `mbb-pd`: strain of the bond then";
    "strain_xy" "-" ANY "with `mbb-pd`: strain of the bond then";
    "strain_yy" "-" ANY "with `mbb-pd`: strain of the bond then";
}

columns! { "First columns of the table of bonds that soften."
    SOFTENING:
    "step" "" ANY "load step";
    "load_factor" "-" ANY "load factor of the step";
    "displacement" "m" ANY "displacement of the load";
    "reaction" "N" ANY "force of the load";
    "event" "" ANY "`begins`, `half`, `quarter` or `opens`";
}

columns! { "The last column of the table of bonds that soften."
    SOFTENED_BY:
    "criterion" "" ANY "criterion whose limit the bond passed";
}

columns! { "Columns of the table of failure criteria."
    CRITERIA:
    "criterion" "" ANY "name of a criterion in results";
    "measure" "" ANY "what it looks at";
    "after" "" ANY "what a bond does after its limit";
}

columns! { "Columns of the table of iterations."
    ITERATIONS:
    "step" "" ANY "load step or event";
    "round" "" ANY "round of breaking";
    "iteration" "" ANY "Newton-Raphson iteration, or correction of the secants";
    "load_factor" "-" ANY "load factor";
    "residual" "-" ANY "unbalanced force over the forces that meet at a point";
    "stored_energy" "J" ANY "energy stored in the bonds";
    "broken_bonds" "" ANY "broken bonds before";
}

columns! { "Columns of the table of times behind [`STEP`], s."
    TIMINGS of Costs, Duration:
    "assembly_s" "s" ANY "making the matrix" => |it| it.assembly;
    "factorisation_s" "s" ANY "new factors" => |it| it.factorisation;
    "change_s" "s" ANY "changes of the factor in place" => |it| it.change;
    "backward_s" "s" ANY "backward substitutions after changes" => |it| it.backward;
    "solve_s" "s" ANY "whole solutions" => |it| it.solve;
    "bonds_s" "s" ANY "sweeps over the bonds: deformations, forces, criteria" => |it| it.bonds;
    "connectivity_s" "s" ANY "search for loose parts" => |it| it.connectivity;
}

columns! { "Columns of the table of natural modes."
    MODES:
    "mode" "" ANY "number of the mode";
    "kind" "" ANY "`rigid` or `elastic`";
    "frequency_hz" "Hz" ANY "natural frequency";
    "angular_frequency" "rad/s" ANY "angular frequency omega";
    "eigenvalue" "1/s^2" ANY "omega^2";
    "residual" "-" ANY "how far the mode is from satisfying its equation";
    "effective_mass_x" "kg" ANY "effective mass along x";
    "effective_mass_y" "kg" ANY "effective mass along y";
    "effective_mass_z" "kg" SOLID "effective mass along z, of a solid";
    "effective_inertia" "kg m^2" PLANE "effective inertia about the centre of mass, in the plane";
    "effective_inertia_x" "kg m^2" SOLID "of a solid, about x";
    "effective_inertia_y" "kg m^2" SOLID "about y";
    "effective_inertia_z" "kg m^2" SOLID "about z";
    "share_x" "-" ANY "share of the effective mass in what can move along x";
    "share_y" "-" ANY "the same along y";
    "share_z" "-" SOLID "the same along z, of a solid";
    "share_inertia" "-" PLANE "the same of the inertia, in the plane";
    "share_inertia_x" "-" SOLID "of a solid, about x";
    "share_inertia_y" "-" SOLID "about y";
    "share_inertia_z" "-" SOLID "about z";
    "participation_x" "kg^(1/2)" ANY "participation in a motion along x, whose square is the effective mass";
    "participation_y" "kg^(1/2)" ANY "along y";
    "participation_z" "kg^(1/2)" SOLID "along z, of a solid";
    "participation_rotation" "kg^(1/2) m" PLANE "about the centre of mass, in the plane";
    "participation_rotation_x" "kg^(1/2) m" SOLID "of a solid, about x";
    "participation_rotation_y" "kg^(1/2) m" SOLID "about y";
    "participation_rotation_z" "kg^(1/2) m" SOLID "about z";
}

columns! { "Columns of the lines of a crack."
    CRACK:
    "step" "" ANY "step of the lines";
    "line" "" ANY "number of the line, from 1";
    "x" "m" ANY "place on the line, in the body without load";
    "y" "m" ANY "place on the line";
    "along" "m" ANY "length of the line up to there";
    "end" "" ANY "at both ends of a line: `tip`, `outline`, `pre-crack` or `junction`; empty between";
}

columns! { "Columns of the tips of cracks."
    CRACK_TIPS:
    "step" "" ANY "step or event";
    "load_factor" "-" ANY "load factor";
    "displacement" "m" ANY "displacement of the load";
    "line" "" ANY "number of the line in this step";
    "x" "m" ANY "the tip";
    "y" "m" ANY "the tip";
}

columns! { "Columns of the tips of cracks in a motion."
    TIP_SPEED:
    "time" "s" ANY "time, in a [motion](motion.md)";
    "speed" "m/s" ANY
        "in a motion: way of the tip along its line since the step before in the table, over the time between; empty for a tip that is new";
}

columns! { "Columns of the growth of cracks."
    CRACK_GROWTH:
    "step" "" ANY "step or event";
    "load_factor" "-" ANY "load factor";
    "displacement" "m" ANY "displacement of the load";
    "reaction" "N" ANY "force of the load";
    "lines" "" PLANE "number of crack lines, in the plane";
    "tips" "" PLANE "number of tips, in the plane";
    "length" "m" PLANE "length of all lines, without pre-cracks, in the plane";
    "parts" "" SOLID "connected parts of the crack surface, of a solid";
    "area" "m^2" ANY "length times the thickness of the body; of a solid area of the surface, without pre-cracks";
    "release_rate_compliance" "J/m^2" ANY "energy release rate from the change of compliance";
    "release_rate_energy" "J/m^2" ANY "released energy over the new area";
    "dissipated_per_area" "J/m^2" ANY "energy that bonds took for good over the new area";
}

columns! { "Columns of the growth of cracks in a motion."
    GROWTH_RATE:
    "time" "s" ANY "time, in a motion";
    "length_rate" "m/s" PLANE "in a motion, in the plane: growth of all lines together over the last five rows of the table; what does not last counts as none";
    "area_rate" "m^2/s" ANY "in a motion: growth of the area over the last five rows of the table; what does not last counts as none";
}

columns! { "The first column of the table of times."
    STEP:
    "step" "" ANY "load step or event";
}

/// The tables of the page of columns by their headings, in the order of the page.
pub fn tables() -> Vec<(&'static str, Vec<Column>)> {
    fn of<R, V>(readings: &[Reading<R, V>]) -> Vec<Column> {
        readings.iter().map(|it| it.0).collect()
    }
    let (history, closing, motion) = (of(HISTORY), of(CLOSING), of(MOTION));
    let of_contacts = [of(CONTACTS), of(RIGID_BODIES)].concat();
    let (breaks, timings) = (of(BREAKS), of(TIMINGS));
    let joined = |parts: &[&[Column]]| parts.concat();
    vec![
        (
            "history.csv",
            joined(&[
                &history,
                STAGES,
                &closing,
                &motion,
                GROUPS,
                &of_contacts,
                PROBES,
            ]),
        ),
        ("breaks.csv", joined(&[&breaks, ENDS, FAILURE, STRAINS])),
        ("softening.csv", joined(&[SOFTENING, ENDS, SOFTENED_BY])),
        ("criteria.csv", CRITERIA.to_vec()),
        ("iterations.csv", ITERATIONS.to_vec()),
        ("timings.csv", joined(&[STEP, &timings])),
        ("modes.csv", MODES.to_vec()),
        ("crack.csv", CRACK.to_vec()),
        ("crack_tips.csv", joined(&[CRACK_TIPS, TIP_SPEED])),
        ("crack_growth.csv", joined(&[CRACK_GROWTH, GROWTH_RATE])),
    ]
}

/// Names of the columns of a table that a body in the plane or a solid has.
pub fn names(columns: &[Column], in_space: bool) -> Vec<&'static str> {
    let here = columns.iter().filter(|it| it.spaces[usize::from(in_space)]);
    here.map(|it| it.name).collect()
}

/// The columns of a table that a body in the plane or a solid has, with the functions that return their values.
pub(super) fn readings<R, V>(
    columns: &[Reading<R, V>],
    in_space: bool,
) -> impl Iterator<Item = &Reading<R, V>> {
    let spaces = usize::from(in_space);
    columns.iter().filter(move |it| it.0.spaces[spaces])
}

/// SI unit of a probe, by the field or the quantity that it reads, or by the component of a motion or of a force.
pub fn unit_of_probe(read: Option<&str>, component: &str, is_force: bool) -> &'static str {
    let is_rotation = component.starts_with("rotation");
    let tips = || TipQuantity::ALL.into_iter();
    match read {
        Some(read) => match tips().find(|it| it.symbol()[0] == read) {
            Some(quantity) => quantity.unit(),
            None => PointField::named(read).map_or("-", |it| it.unit()),
        },
        None if is_force && is_rotation => "N m",
        None if is_force => "N",
        None => motion_unit(is_rotation),
    }
}

/// Whether a column of a table holds counts or words, rather than numbers of any size.
pub fn is_count(table: &str, column: &str) -> bool {
    let tables = tables().into_iter().filter(|it| it.0 == table);
    let mut columns = tables.flat_map(|it| it.1);
    columns.any(|it| it.name == column && it.unit.is_empty())
}

/// Name of the column of the time of a motion.
pub const TIME: &str = MOTION[0].0.name;

/// Whether a history with these columns belongs to a motion in time.
pub fn is_in_time(columns: &[String]) -> bool {
    let mut own = MOTION.iter();
    own.all(|it| columns.iter().any(|column| column == it.0.name))
}

/// SI unit of a column of a table of cracks, by the name of its file; `None` for other tables.
pub fn unit_of_crack(file: &str, column: &str) -> Option<&'static str> {
    let all: [&[Column]; 2] = match file {
        "crack_growth.csv" => [CRACK_GROWTH, GROWTH_RATE],
        "crack_tips.csv" => [CRACK_TIPS, TIP_SPEED],
        _ => return None,
    };
    let found = all.into_iter().flatten().find(|it| it.name == column)?;
    Some(if found.unit.is_empty() {
        "-"
    } else {
        found.unit
    })
}

/// SI unit of a column of a history; `-` for a number without a unit, and for probes, whose units follow from the case.
pub fn unit_of(column: &str) -> &'static str {
    let of_group = |it: &Column| match (it.name.split_once('.'), column.rsplit_once('.')) {
        (Some((_, one)), Some((_, other))) => one == other,
        _ => false,
    };
    let history = HISTORY.iter().map(|it| &it.0);
    let mut history = history.chain(MOTION.iter().map(|it| &it.0));
    let found = history.find(|it| it.name == column);
    let named = GROUPS.iter().chain(CONTACTS.iter().map(|it| &it.0));
    let mut named = named.chain(RIGID_BODIES.iter().map(|it| &it.0));
    let found = found.or_else(|| named.find(|it| of_group(it)));
    found.map_or("-", |it| if it.unit.is_empty() { "-" } else { it.unit })
}
