// SPDX-License-Identifier: BSD-3-Clause
//! One scenario: its names, its handles, and each function of C by the method that calls it.
use super::json::{bytes, from_bytes, Json, Value};
use super::models;
use cairn::*;
use std::collections::HashMap;
use std::sync::{Arc, Mutex};

/// A handle, or the place from which a map is borrowed.
enum Handle {
    Filter(Filter),
    Copy(MapCopy),
    Team(Team),
    World(World),
    Fleet(Fleet),
    MapOf(String),
    LocalMapOf(String),
}

#[derive(Default)]
pub struct Replay {
    values: HashMap<String, Value>,
    handles: HashMap<String, Handle>,
    created: Vec<String>,
    log: Arc<Mutex<Vec<String>>>,
}

/// The inputs of a call by the names of the parameters in C.
struct Inputs(Vec<(String, Value)>);

impl Inputs {
    fn find(&self, name: &str) -> Option<&Value> {
        self.0.iter().find(|input| input.0 == name).map(|input| &input.1)
    }
    fn value(&self, name: &str) -> &Value {
        self.find(name).unwrap_or_else(|| panic!("no input {name}"))
    }
    fn get<T: Json>(&self, name: &str) -> T {
        T::read(self.value(name))
    }
    fn maybe<T: Json>(&self, name: &str) -> Option<T> {
        self.find(name).map(T::read)
    }
    fn list<T: Json>(&self, name: &str) -> Vec<T> {
        self.maybe(name).unwrap_or_default()
    }
    fn text(&self, name: &str) -> &str {
        self.value(name).text()
    }
    fn sensor(&self) -> Sensor {
        Sensor(self.get("sensor"))
    }
}

type Outputs = Vec<(String, Value)>;

macro_rules! outputs {
    ($($name:literal: $value:expr),* $(,)?) => {
        Ok(vec![$(($name.to_string(), $value.write())),*])
    };
}

fn init<T: Default + Json>(name: &str) -> Result<Outputs> {
    Ok(vec![(name.into(), T::default().write())])
}

fn flat<const N: usize>(points: &[[f64; N]]) -> Vec<f64> {
    points.concat()
}

impl Replay {
    pub fn new() -> Replay {
        Replay::default()
    }

    /// Makes a call and returns its element of the output; `None` if such a call is not a program in Rust.
    pub fn call(&mut self, call: &Value) -> Option<Value> {
        let name = call.get("call").unwrap().text();
        let given = call.get("gives");
        let inputs = match call.get("with") {
            Some(Value::Object(inputs)) => {
                Inputs(inputs.iter().map(|(name, value)| (name.clone(), self.resolved(value))).collect())
            }
            _ => Inputs(Vec::new()),
        };
        if does_not_compile(name, &inputs, self) {
            return None;
        }
        let mut element = vec![("call".to_string(), Value::Text(name.into()))];
        let named = |output: &str| match given.and_then(|given| given.get(output)) {
            Some(Value::Text(name)) if name.starts_with('$') => Some(name.clone()),
            _ => None,
        };
        match self.run(name, &inputs, &named) {
            Ok(outputs) => {
                for (output, value) in &outputs {
                    if let Some(name) = named(output) {
                        self.values.insert(name, value.clone());
                    }
                }
                if !outputs.is_empty() {
                    element.push(("gives".into(), Value::Object(outputs)));
                }
            }
            Err(error) => {
                // An error that a callback returned is the caller's own; the library's message stands beside it.
                element.push(("status".into(), Value::Text(error.status().name().into())));
                element.push(("message".into(), Value::Text(error.message().into())));
            }
        }
        let lines = std::mem::take(&mut *self.log.lock().unwrap());
        if !lines.is_empty() {
            element.push(("log".into(), lines.write()));
        }
        Some(Value::Object(element))
    }

    /// The value with the outputs of earlier calls in the place of their names. Names of handles stay.
    fn resolved(&self, value: &Value) -> Value {
        match value {
            Value::Text(text) if text.starts_with('$') => {
                let mut path = text.split('.');
                let name = path.next().unwrap();
                match self.values.get(name) {
                    Some(value) if !self.handles.contains_key(name) => path
                        .fold(value, |value, key| match key.parse::<usize>() {
                            Ok(index) => &value.list()[index],
                            Err(_) => value.get(key).unwrap_or_else(|| panic!("no {key} in {text}")),
                        })
                        .clone(),
                    _ => value.clone(),
                }
            }
            Value::List(list) => Value::List(list.iter().map(|value| self.resolved(value)).collect()),
            Value::Object(fields) => {
                Value::Object(fields.iter().map(|(name, value)| (name.clone(), self.resolved(value))).collect())
            }
            other => other.clone(),
        }
    }

    fn keep(&mut self, name: Option<String>, output: &str, handle: Handle) -> Result<Outputs> {
        let name = name.expect("a handle needs a name");
        if !matches!(handle, Handle::MapOf(_) | Handle::LocalMapOf(_)) {
            self.created.push(name.clone());
        }
        self.handles.insert(name.clone(), handle);
        Ok(vec![(output.into(), Value::Text(name))])
    }

    fn destroy(&mut self, name: &str) -> Result<Outputs> {
        self.handles.remove(name).expect("a handle");
        self.created.retain(|created| created != name);
        Ok(Vec::new())
    }

    fn filter(&mut self, i: &Inputs) -> &mut Filter {
        match self.handles.get_mut(i.text("filter")) {
            Some(Handle::Filter(filter)) => filter,
            _ => panic!("no filter {}", i.text("filter")),
        }
    }
    fn team(&mut self, i: &Inputs) -> &mut Team {
        match self.handles.get_mut(i.text("team")) {
            Some(Handle::Team(team)) => team,
            _ => panic!("no team {}", i.text("team")),
        }
    }
    fn world(&mut self, i: &Inputs) -> &mut World {
        match self.handles.get_mut(i.text("world")) {
            Some(Handle::World(world)) => world,
            _ => panic!("no world {}", i.text("world")),
        }
    }
    fn fleet(&mut self, i: &Inputs) -> &mut Fleet {
        match self.handles.get_mut(i.text("fleet")) {
            Some(Handle::Fleet(fleet)) => fleet,
            _ => panic!("no fleet {}", i.text("fleet")),
        }
    }
    fn map(&self, name: &str) -> &Map {
        match self.handles.get(name) {
            Some(Handle::Copy(copy)) => copy,
            Some(Handle::MapOf(owner)) => match self.handles.get(owner) {
                Some(Handle::Filter(filter)) => filter.map(),
                Some(Handle::Team(team)) => team.map(),
                _ => panic!("no owner {owner}"),
            },
            Some(Handle::LocalMapOf(owner)) => match self.handles.get(owner) {
                Some(Handle::Filter(filter)) => filter.local_map(),
                _ => panic!("no owner {owner}"),
            },
            _ => panic!("no map {name}"),
        }
    }

    fn run(&mut self, function: &str, i: &Inputs, named: &dyn Fn(&str) -> Option<String>) -> Result<Outputs> {
        match function.split('_').nth(1).unwrap() {
            "filter" => self.run_filter(function, i, named),
            "map" => self.run_map(function, i, named),
            "team" => self.run_team(function, i, named),
            "world" => self.run_world(function, i, named),
            "fleet" => self.run_fleet(function, i, named),
            _ => run_free(function, i),
        }
    }

    fn run_filter(&mut self, function: &str, i: &Inputs, named: &dyn Fn(&str) -> Option<String>) -> Result<Outputs> {
        match function {
            "cairn_filter_options_init" => init::<FilterOptions>("options"),
            "cairn_filter_required_bytes" => outputs!["bytes": i.get::<FilterOptions>("options").required_bytes()?],
            "cairn_filter_create" => {
                let filter = Filter::new(&i.get("options"))?;
                self.keep(named("filter"), "filter", Handle::Filter(filter))
            }
            "cairn_filter_destroy" => self.destroy(i.text("filter")),
            "cairn_filter_set_log" => {
                let log = Arc::clone(&self.log);
                match i.find("log") {
                    Some(_) => self.filter(i).set_log(move |line| log.lock().unwrap().push(line.into()))?,
                    None => self.filter(i).clear_log()?,
                }
                outputs![]
            }
            "cairn_filter_add_stereo_head" => outputs!["sensor": self.filter(i).add_stereo_head(&i.get("head"))?.0],
            "cairn_filter_add_stereo_camera" => {
                outputs!["sensor": self.filter(i).add_stereo_camera(&i.get("camera"))?.0]
            }
            "cairn_filter_add_range_bearing" => {
                outputs!["sensor": self.filter(i).add_range_bearing(&i.get("radar"))?.0]
            }
            "cairn_filter_add_cartesian" => outputs!["sensor": self.filter(i).add_cartesian(&i.get("cartesian"))?.0],
            "cairn_filter_add_custom" => {
                let (custom, predict): (Custom, String) = (i.get("custom"), i.get("predict"));
                let predict = move |pose: &Pose, landmark: &[f64; 3], out: Prediction<'_>| {
                    models::predict(&predict, pose, landmark, out)
                };
                let sensor = match i.maybe::<String>("place") {
                    Some(place) => self
                        .filter(i)
                        .add_custom(&custom, predict, move |pose, z, out| models::place(&place, pose, z, out))?,
                    None => self.filter(i).add_custom_observer(&custom, predict)?,
                };
                outputs!["sensor": sensor.0]
            }
            "cairn_filter_point_head" => {
                self.filter(i).point_head(i.sensor(), i.get("pan"), i.get("stick"))?;
                outputs![]
            }
            "cairn_filter_set_loss" => {
                self.filter(i).set_loss(i.sensor(), i.get("loss"), i.get("width"))?;
                outputs![]
            }
            "cairn_filter_set_view" => {
                self.filter(i).set_view(i.sensor(), &i.get("lower"), &i.get("upper"))?;
                outputs![]
            }
            "cairn_filter_calibrate_sensor" => {
                self.filter(i).calibrate_sensor(i.sensor(), &i.get("calibration"))?;
                outputs![]
            }
            "cairn_filter_set_wheels" => {
                self.filter(i).set_wheels(&i.get("wheels"))?;
                outputs![]
            }
            "cairn_filter_set_twist_noise" => {
                self.filter(i).set_twist_noise(&i.get("noise"))?;
                outputs![]
            }
            "cairn_filter_predict_wheels" => {
                self.filter(i).predict_wheels(i.get("dt"), i.get("left_rad_per_s"), i.get("right_rad_per_s"))?;
                outputs![]
            }
            "cairn_filter_predict_wheels_gyro" => {
                let (left, right) = (i.get("left_rad_per_s"), i.get("right_rad_per_s"));
                self.filter(i).predict_wheels_gyro(i.get("dt"), left, right, &i.get("rate"))?;
                outputs![]
            }
            "cairn_filter_predict_twist" => {
                self.filter(i).predict_twist(i.get("dt"), &i.get("velocity"), &i.get("rate"))?;
                outputs![]
            }
            "cairn_filter_predict_increment" => {
                self.filter(i).predict_increment(&i.get("T_before_after"), &i.get("covariance"))?;
                outputs![]
            }
            "cairn_filter_update" => {
                let observations: Vec<Observation> = i.list("observations");
                outputs!["matches": self.filter(i).update(i.sensor(), &observations)?]
            }
            "cairn_filter_update_linear" => {
                let (residual, covariance, landmarks): (Vec<f64>, Vec<f64>, Vec<u64>) =
                    (i.list("residual"), i.list("covariance"), i.list("landmarks"));
                let (pose, jacobian): (Option<Vec<f64>>, Vec<f64>) =
                    (i.maybe("jacobian_pose"), i.list("jacobian_landmarks"));
                let filter = self.filter(i);
                outputs!["match":
                    filter.update_linear(&residual, &covariance, pose.as_deref(), &landmarks, &jacobian)?]
            }
            "cairn_filter_update_position" => {
                let arm: Option<[f64; 3]> = i.maybe("lever_arm");
                outputs!["match":
                    self.filter(i).update_position(&i.get("position"), &i.get("covariance"), arm.as_ref())?]
            }
            "cairn_filter_update_attitude" => {
                outputs!["match": self.filter(i).update_attitude(&i.get("quaternion"), &i.get("covariance"))?]
            }
            "cairn_filter_update_heading" => {
                outputs!["match": self.filter(i).update_heading(i.get("heading"), i.get("sigma"))?]
            }
            "cairn_filter_remove_landmark" => {
                self.filter(i).remove_landmark(i.get("id"))?;
                outputs![]
            }
            "cairn_filter_merge_landmarks" => {
                outputs!["match": self.filter(i).merge_landmarks(i.get("id"), i.get("other"))?]
            }
            "cairn_filter_split_landmark" => {
                self.filter(i).split_landmark(i.get("id"), i.get("fresh"), &i.get("covariance"))?;
                outputs![]
            }
            "cairn_filter_close_submap" => {
                self.filter(i).close_submap()?;
                outputs![]
            }
            "cairn_filter_last_closing" => outputs!["report": self.filter(i).last_closing()?],
            "cairn_filter_submap_count" => outputs!["count": self.filter(i).submap_count()?],
            "cairn_filter_submap" => {
                let submap = self.filter(i).submap(i.get("index"))?;
                outputs!["base": submap.base, "ids": submap.ids]
            }
            "cairn_filter_local_pose" => posed(self.filter(i).local_pose()?),
            "cairn_filter_base_pose" => posed(self.filter(i).base_pose()?),
            "cairn_filter_pose" => posed(self.filter(i).pose()?),
            "cairn_filter_last_update" => outputs!["report": self.filter(i).last_update()?],
            "cairn_filter_joint_covariance" => {
                outputs!["matrix": self.filter(i).joint_covariance(&i.list::<u64>("ids"))?]
            }
            "cairn_filter_map" => self.keep(named("return"), "return", Handle::MapOf(i.text("filter").into())),
            "cairn_filter_local_map" => {
                self.keep(named("return"), "return", Handle::LocalMapOf(i.text("filter").into()))
            }
            "cairn_filter_pose_nees" => outputs!["nees": self.filter(i).pose_nees(&i.get("truth"))?],
            "cairn_filter_audit" => outputs!["min_pivot": self.filter(i).audit()?],
            "cairn_filter_health" => outputs!["health": self.filter(i).health()?],
            "cairn_filter_sensor_health" => outputs!["health": self.filter(i).sensor_health(i.sensor())?],
            "cairn_filter_systematic_errors" => {
                let (errors, covariance) = self.filter(i).systematic_errors()?;
                outputs!["errors": errors, "covariance": covariance]
            }
            "cairn_filter_keep_pose" => outputs!["number": self.filter(i).keep_pose()?],
            "cairn_filter_trajectory_range" => {
                let range = self.filter(i).trajectory_range()?;
                outputs!["first": range.start, "end": range.end]
            }
            "cairn_filter_trajectory" => outputs!["poses": self.filter(i).trajectory(i.get("first"))?],
            _ => panic!("no method for {function}"),
        }
    }

    fn run_map(&mut self, function: &str, i: &Inputs, named: &dyn Fn(&str) -> Option<String>) -> Result<Outputs> {
        if function == "cairn_map_destroy" {
            return self.destroy(i.text("map"));
        }
        if function == "cairn_map_merge" {
            let mut copy = match self.handles.remove(i.text("map")) {
                Some(Handle::Copy(copy)) => copy,
                _ => panic!("no copy"),
            };
            let options: Option<MergeOptions> = i.maybe("options");
            let report = copy.merge(self.map(i.text("other")), options.as_ref());
            self.handles.insert(i.text("map").into(), Handle::Copy(copy));
            return outputs!["report": report?];
        }
        let map = self.map(i.text("map"));
        match function {
            "cairn_map_size" => outputs!["count": map.size()?],
            "cairn_map_landmark" => outputs!["landmark": map.landmark(i.get("id"))?],
            "cairn_map_landmarks" => outputs!["landmarks": map.landmarks()?],
            "cairn_map_within" => outputs!["landmarks": map.within(&i.get("centre"), i.get("radius"))?],
            "cairn_map_nearest" => outputs!["landmarks": map.nearest(&i.get("point"), i.get("count"))?],
            "cairn_map_in_box" => outputs!["landmarks": map.in_box(&i.get("lower"), &i.get("upper"))?],
            "cairn_map_joint_covariance" => outputs!["matrix": map.joint_covariance(&i.list::<u64>("ids"))?],
            "cairn_map_kind" => outputs!["kind": map.kind()?],
            "cairn_map_merged_ids" => outputs!["merged": map.merged_ids()?],
            "cairn_map_copy" => {
                let copy = map.copy()?;
                self.keep(named("copy"), "copy", Handle::Copy(copy))
            }
            _ => panic!("no method for {function}"),
        }
    }

    fn run_team(&mut self, function: &str, i: &Inputs, named: &dyn Fn(&str) -> Option<String>) -> Result<Outputs> {
        match function {
            "cairn_team_options_init" => init::<TeamOptions>("options"),
            "cairn_team_create" => {
                let team = Team::new(&i.get("options"), &i.get("filter"), &i.get("radar"))?;
                self.keep(named("team"), "team", Handle::Team(team))
            }
            "cairn_team_destroy" => self.destroy(i.text("team")),
            "cairn_team_add" => {
                let (start, covariance): (Option<Pose>, Option<Covariance>) = (i.maybe("start"), i.maybe("covariance"));
                self.team(i).add(i.get("vehicle"), start.as_ref(), covariance.as_ref())?;
                outputs![]
            }
            "cairn_team_remove" => {
                self.team(i).remove(i.get("vehicle"))?;
                outputs![]
            }
            "cairn_team_members" => outputs!["vehicles": self.team(i).members()?],
            "cairn_team_predict_increment" => {
                self.team(i).predict_increment(&i.get("T_before_after"), &i.get("covariance"))?;
                outputs![]
            }
            "cairn_team_predict_twist" => {
                let noise: Option<TwistNoise> = i.maybe("noise");
                let (velocity, rate) = (i.get("velocity"), i.get("rate"));
                self.team(i).predict_twist(i.get("dt"), &velocity, &rate, noise.as_ref())?;
                outputs![]
            }
            "cairn_team_observe" => {
                let (landmarks, vehicles): (Vec<Observation>, Vec<Observation>) =
                    (i.list("landmarks"), i.list("vehicles"));
                self.team(i).observe(i.get("time"), &landmarks, &vehicles)?;
                outputs![]
            }
            "cairn_team_decisions" => outputs!["matches": self.team(i).decisions()?],
            "cairn_team_leave" => {
                self.team(i).leave()?;
                outputs![]
            }
            "cairn_team_take_packet" => {
                let packet = self.team(i).take_packet()?.unwrap_or_default();
                Ok(vec![("packet".into(), from_bytes(&packet))])
            }
            "cairn_team_ask" => {
                self.team(i).ask()?;
                outputs![]
            }
            "cairn_team_receive" => outputs!["result": self.team(i).receive(&bytes(i.value("packet")))?],
            "cairn_team_pose" => posed(self.team(i).pose(i.get("vehicle"))?),
            "cairn_team_pose_nees" => outputs!["nees": self.team(i).pose_nees(&i.get("truth"))?],
            "cairn_team_map" => self.keep(named("return"), "return", Handle::MapOf(i.text("team").into())),
            "cairn_team_score" => {
                self.team(i).score(&i.get("truth"))?;
                outputs![]
            }
            "cairn_team_last_report" => outputs!["report": self.team(i).last_report()?],
            _ => panic!("no method for {function}"),
        }
    }

    fn run_world(&mut self, function: &str, i: &Inputs, named: &dyn Fn(&str) -> Option<String>) -> Result<Outputs> {
        match function {
            "cairn_world_options_init" => init::<WorldOptions>("options"),
            "cairn_world_options_preset" => {
                let mut options: WorldOptions = i.maybe("options").unwrap_or_default();
                let submap_landmarks = options.set_preset(i.get("preset"))?;
                outputs!["options": options, "submap_landmarks": submap_landmarks]
            }
            "cairn_world_create" => {
                let world = World::new(&i.get("options"))?;
                self.keep(named("world"), "world", Handle::World(world))
            }
            "cairn_world_destroy" => self.destroy(i.text("world")),
            "cairn_world_next" => outputs!["step": self.world(i).advance()?],
            "cairn_world_motions" => outputs!["motions": self.world(i).motions()?],
            "cairn_world_observations" => outputs!["observations": self.world(i).observations()?],
            "cairn_world_rewind" => {
                self.world(i).rewind()?;
                outputs![]
            }
            "cairn_world_steps" => outputs!["steps": self.world(i).steps()?],
            "cairn_world_most_observations" => outputs!["count": self.world(i).most_observations()?],
            "cairn_world_head" => outputs!["head": self.world(i).head()?],
            "cairn_world_wheels" => outputs!["wheels": self.world(i).wheels()?],
            "cairn_world_pose" => outputs!["pose": self.world(i).pose(i.get("time"))?],
            "cairn_world_contacts" => outputs!["points": flat(&self.world(i).contacts(i.get("time"))?)],
            "cairn_world_height" => outputs!["height": self.world(i).height(i.get("x"), i.get("y"))?],
            "cairn_world_extent" => {
                let (lower, upper) = self.world(i).extent()?;
                outputs!["lower": lower, "upper": upper]
            }
            "cairn_world_landmark" => outputs!["position": self.world(i).landmark(i.get("id"))?],
            "cairn_world_landmarks" => outputs!["positions": flat(&self.world(i).landmarks()?)],
            _ => panic!("no method for {function}"),
        }
    }

    fn run_fleet(&mut self, function: &str, i: &Inputs, named: &dyn Fn(&str) -> Option<String>) -> Result<Outputs> {
        match function {
            "cairn_fleet_options_init" => init::<FleetOptions>("options"),
            "cairn_fleet_create" => {
                let fleet = Fleet::new(&i.get("options"))?;
                self.keep(named("fleet"), "fleet", Handle::Fleet(fleet))
            }
            "cairn_fleet_destroy" => self.destroy(i.text("fleet")),
            "cairn_fleet_next" => outputs!["step": self.fleet(i).advance()?],
            "cairn_fleet_vehicles" => outputs!["vehicles": self.fleet(i).vehicles()?],
            "cairn_fleet_seen_features" => outputs!["features": self.fleet(i).seen_features(i.get("vehicle"))?],
            "cairn_fleet_seen_vehicles" => outputs!["vehicles": self.fleet(i).seen_vehicles(i.get("vehicle"))?],
            "cairn_fleet_rewind" => {
                self.fleet(i).rewind()?;
                outputs![]
            }
            "cairn_fleet_steps" => outputs!["steps": self.fleet(i).steps()?],
            "cairn_fleet_features" => outputs!["positions": flat(&self.fleet(i).features()?)],
            "cairn_fleet_coast" => outputs!["points": flat(&self.fleet(i).coast()?)],
            _ => panic!("no method for {function}"),
        }
    }
}

impl Drop for Replay {
    /// Handles end newest first.
    fn drop(&mut self) {
        for name in self.created.iter().rev() {
            self.handles.remove(name);
        }
    }
}

/// Calls that are errors in C and that the compiler refuses in Rust: a map that a filter owns cannot be changed, and a
/// map cannot be changed while it is read.
fn does_not_compile(function: &str, i: &Inputs, replay: &Replay) -> bool {
    function == "cairn_map_merge"
        && (!matches!(replay.handles.get(i.text("map")), Some(Handle::Copy(_))) || i.text("map") == i.text("other"))
}

fn posed((pose, covariance): (Pose, Covariance)) -> Result<Outputs> {
    outputs!["pose": pose, "covariance": covariance]
}

fn run_free(function: &str, i: &Inputs) -> Result<Outputs> {
    match function {
        "cairn_status_name" => outputs!["return": i.get::<Status>("status").name().to_string()],
        "cairn_verdict_text" => outputs!["return": i.get::<Verdict>("verdict").text().to_string()],
        "cairn_doubt_text" => outputs!["return": i.get::<Doubts>("reason").text().to_string()],
        "cairn_version" => outputs!["return": version().to_string()],
        "cairn_version_number" => outputs!["return": version_number()],
        "cairn_build" => outputs!["return": build().to_string()],
        "cairn_has" => outputs!["return": has(i.text("feature"))],
        "cairn_id_none" => outputs!["return": id_none()],
        "cairn_pose_identity" => outputs!["pose": Pose::identity()],
        "cairn_pose_compose" => outputs!["result": i.get::<Pose>("T_a_b").compose(&i.get("T_b_c"))?],
        "cairn_pose_inverse" => outputs!["result": i.get::<Pose>("T_a_b").inverse()?],
        "cairn_pose_apply" => outputs!["point_a": i.get::<Pose>("T_a_b").apply(&i.get("point_b"))?],
        "cairn_pose_error" => outputs!["difference": Pose::error(&i.get("truth"), &i.get("estimate"))?],
        "cairn_quaternion_from_euler" => {
            outputs!["quaternion": quaternion_from_euler(i.get("roll"), i.get("pitch"), i.get("yaw"))?]
        }
        "cairn_quaternion_to_euler" => {
            let [roll, pitch, yaw] = quaternion_to_euler(&i.get("quaternion"))?;
            outputs!["roll": roll, "pitch": pitch, "yaw": yaw]
        }
        "cairn_quaternion_exp" => outputs!["quaternion": quaternion_exp(&i.get("rotation_vector"))?],
        "cairn_quaternion_log" => outputs!["rotation_vector": quaternion_log(&i.get("quaternion"))?],
        "cairn_wheels_init" => init::<Wheels>("wheels"),
        "cairn_twist_noise_init" => init::<TwistNoise>("noise"),
        "cairn_stereo_head_init" => init::<StereoHead>("head"),
        "cairn_stereo_camera_init" => init::<StereoCamera>("camera"),
        "cairn_range_bearing_init" => init::<RangeBearing>("radar"),
        "cairn_cartesian_init" => init::<Cartesian>("cartesian"),
        "cairn_custom_init" => init::<Custom>("custom"),
        "cairn_calibration_init" => init::<Calibration>("calibration"),
        "cairn_merge_options_init" => init::<MergeOptions>("options"),
        "cairn_custom_check" => {
            let (custom, predict): (Custom, &str) = (i.get("custom"), i.text("predict"));
            let predict =
                |pose: &Pose, landmark: &[f64; 3], out: Prediction<'_>| models::predict(predict, pose, landmark, out);
            let (pose, landmark) = (i.get("pose"), i.get("landmark"));
            let worst = match i.find("place") {
                Some(place) => {
                    let place = |pose: &Pose, z: &[f64], out: Placement<'_>| models::place(place.text(), pose, z, out);
                    custom.check(predict, place, &pose, &landmark)?
                }
                None => custom.check_observer(predict, &pose, &landmark)?,
            };
            outputs!["worst": worst]
        }
        _ => panic!("no method for {function}"),
    }
}
