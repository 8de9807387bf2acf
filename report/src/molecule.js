// SPDX-License-Identifier: BSD-3-Clause
// The page of a molecule.
import {start} from './app.js';
import {make_molecule_scene} from './molecule_scene.js';
import {make_residues_chart} from './residues_chart.js';

start(make_molecule_scene, make_residues_chart);
