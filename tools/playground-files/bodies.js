// The bodies to choose from, and what their sliders change: the key, what it is called, and its range in a unit that is `factor` of the SI unit.

const HORIZON = { key: "model.horizon_factor", name: "Horizon", low: 2, high: 4.5, step: 0.1, factor: 1, unit: "× spacing" };
const STRENGTH = { key: "material.tensile_strength", name: "Strength", low: 1, high: 8, step: 0.01, factor: 1e6, unit: "MPa" };
const ENERGY = { key: "material.fracture_energy", name: "Fracture energy", low: 5, high: 300, step: 1, factor: 1, unit: "J/m²" };
const load = (name, low, high, step, factor) => ({ key: "load.displacement.y", name, low, high, step, factor, unit: "mm" });

const BODIES = [
  {
    id: "disk", name: "Disk", sliders: [HORIZON, STRENGTH, ENERGY, load("Pressed by", 0.1, 0.4, 0.01, -1e-3)],
    about: "A disk of rock between two platens. It splits along its middle, as in the laboratory: 3,000 points, 38,000 bonds.",
    picture: "<circle cx='24' cy='24' r='15'/><path class='crack' d='M24 10l-1 7 2 5-1 6 1 5-1 5'/><path class='tool' d='M16 6h16M16 42h16'/>",
  },
  {
    id: "l-panel", name: "L-panel", sliders: [HORIZON, STRENGTH, ENERGY, load("Pushed up by", 0.1, 1.2, 0.05, 1e-3)],
    about: "An L-shaped panel of concrete, pushed up at its arm. The crack starts in the corner and curves; bonds soften before they break.",
    picture: "<path d='M8 8h32v15H24v17H8z'/><path class='crack' d='M24 23l-5-2-5 1-6-3'/><path class='tool' d='M37 34v-9m-3 3l3-3 3 3'/>",
  },
  {
    id: "beam", name: "Beam", sliders: [HORIZON, STRENGTH, ENERGY, load("Bent by", 0.4, 2, 0.1, -1e-3)],
    about: "A notched beam of concrete in bending. The crack grows from the notch while the force falls: the area below the curve is what it spent.",
    picture: "<path d='M4 18h40v14H25v-6h-2v6H4z'/><path class='crack' d='M24 26l1-3-1-5'/><path class='tool' d='M24 7v9m-3-3l3 3 3-3M8 39l3-5 3 5zM34 39l3-5 3 5z'/>",
  },
  {
    id: "holes", name: "Holes", sliders: [HORIZON, STRENGTH, ENERGY, load("Pulled by", 0.02, 0.3, 0.01, 1e-3)],
    about: "A plate with holes on a lattice, without a mesh. The exact path: the program follows it from one breaking bond to the next.",
    picture: "<path d='M10 8h28v32H10z'/><g class='hole'><circle cx='17' cy='27' r='4'/><circle cx='26' cy='21' r='5'/><circle cx='33' cy='27' r='3.4'/></g><path class='crack' d='M10 27l3 0M20 25l2-2M30 23l1 2M36 27h2'/><path class='tool' d='M14 4h20M14 44h20'/>",
  },
  {
    id: "block", name: "Block", sliders: [HORIZON, STRENGTH, ENERGY, load("Pulled by", 0.01, 0.06, 0.002, 1e-3)],
    about: "A solid block of tetrahedra, split from a starter crack. Turn it with a drag, cut it with a section, look at the surface of the crack.",
    picture: "<path d='M6 18l10-8h26v20l-10 8H6z'/><path d='M6 18h26l10-8M32 18v20'/><path class='crack' d='M6 28h16l4-1M32 28l10-8'/>",
  },
  {
    id: "cooled", name: "Cooled", sliders: [HORIZON, STRENGTH, ENERGY, { key: "temperature.change", name: "Cooled by", low: 5, high: 100, step: 1, factor: -1, unit: "K" }],
    about: "A plate between rollers is cooled, and cannot shrink: a crack in its edge runs. No load but the temperature.",
    picture: "<path d='M8 15h32v18H8z'/><path class='crack' d='M24 33v-8l1-4-1-5'/><path class='tool' d='M4 12v24M44 12v24'/>",
  },
];
