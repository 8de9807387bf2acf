// SPDX-License-Identifier: BSD-3-Clause
// For biocd_fcl and robocd_fcl: these programs have no variants for other instruction sets.
extern const char hinge_build_id[];
const char hinge_build_id[] = "with FCL";
extern const char hinge_programs_folder[];
const char hinge_programs_folder[] = "";
