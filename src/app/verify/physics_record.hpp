// What stands behind a picture, as data that is kept beside it: a model as it was read, a scene and its runs.
// And what differs between two such records, in words of the field. Nothing in a record depends on the
// folder, the user, the time, the locale or line endings.
#pragma once

#include <string>
#include <vector>

#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "core/json.hpp"
#include "model/model_description.hpp"
#include "model/model_difference.hpp"

namespace chainreel {

// All of a model that pictures and motion depend on; of meshes enough to say what share of their triangles
// differs. Throws Error as read_chain does.
Json model_record(const ModelSource& urdf, const ModelOptions& options,
                  DescribeCollisions collisions = DescribeCollisions::where_seen);

// Per panel the keys of its scene, the model, the method that was taken, and the trajectory: its hash and
// some 200 samples of it.
Json run_record(const PreparedFilm& film, const Runs& runs);

// Sentences, the most telling first; empty where nothing differs. They throw Error (bad input) where one is
// no such record.
std::vector<std::string> explain_models(const Json& before, const Json& after);

// Whether something of that kind differs in a model, be the records of models or of runs.
bool have_change(const Json& before, const Json& after, ModelChange change);

// Whether two records that differ, of models or of runs, tell of one motion: titles, colours, layers and shapes are others.
bool differ_in_looks_alone(const Json& before, const Json& after);

// A trajectory that differs for one reason is told together with it: "q2 (elbow) differs by 3.1e-4 rad from t
// = 0.81 s on (largest 0.02 rad at t = 3.2 s): method rk4 -> dop853".
std::vector<std::string> explain_runs(const Json& before, const Json& after);

// Whether nothing but the method, its step or its tolerances differs, and no coordinate by more than a thousandth of its range.
bool is_same_motion(const Json& before, const Json& after);

// "pose: elbow 90 -> 90.06 deg". Positions in the order of `coordinate_names` (position_names of a chain).
// Units are known where `model`, the record of the later model, is given.
std::vector<std::string> explain_poses(const std::vector<double>& before, const std::vector<double>& after,
                                       const std::vector<std::string>& coordinate_names,
                                       const Json& model = {});

}  // namespace chainreel
