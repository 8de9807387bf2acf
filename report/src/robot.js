// SPDX-License-Identifier: BSD-3-Clause
// The page of a robot.
import {start} from './app.js';
import {make_matrix_chart} from './matrix_chart.js';
import {make_robot_scene} from './robot_scene.js';

start(make_robot_scene, make_matrix_chart);
