// SPDX-License-Identifier: BSD-3-Clause
// Written by generate.py from api.json. Do not edit.
use super::json::{Fields, Json, Value};
use cairn::*;

impl Json for Status {
    fn read(value: &Value) -> Self {
        Status(value.constant(&[("CAIRN_OK", 0), ("CAIRN_ERROR_ARGUMENT", -1), ("CAIRN_ERROR_BUFFER", -2), ("CAIRN_ERROR_CAPACITY", -3), ("CAIRN_ERROR_NOT_FOUND", -4), ("CAIRN_ERROR_NUMERICAL", -5), ("CAIRN_ERROR_MEMORY", -6), ("CAIRN_ERROR_STATE", -7), ("CAIRN_ERROR_INTERNAL", -8), ("CAIRN_ERROR_CALLBACK", -9)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_OK", 0), ("CAIRN_ERROR_ARGUMENT", -1), ("CAIRN_ERROR_BUFFER", -2), ("CAIRN_ERROR_CAPACITY", -3), ("CAIRN_ERROR_NOT_FOUND", -4), ("CAIRN_ERROR_NUMERICAL", -5), ("CAIRN_ERROR_MEMORY", -6), ("CAIRN_ERROR_STATE", -7), ("CAIRN_ERROR_INTERNAL", -8), ("CAIRN_ERROR_CALLBACK", -9)])
    }
}

impl Json for MapForm {
    fn read(value: &Value) -> Self {
        MapForm(value.constant(&[("CAIRN_MAP_DENSE", 0), ("CAIRN_MAP_SPARSE", 1)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_MAP_DENSE", 0), ("CAIRN_MAP_SPARSE", 1)])
    }
}

impl Json for MergeBy {
    fn read(value: &Value) -> Self {
        MergeBy(value.constant(&[("CAIRN_MERGE_BY_ID", 0), ("CAIRN_MERGE_BY_GEOMETRY", 1)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_MERGE_BY_ID", 0), ("CAIRN_MERGE_BY_GEOMETRY", 1)])
    }
}

impl Json for Yaw {
    fn read(value: &Value) -> Self {
        Yaw(value.constant(&[("CAIRN_YAW_RIGHT_MINUS_LEFT", 0), ("CAIRN_YAW_LEFT_MINUS_RIGHT", 1)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_YAW_RIGHT_MINUS_LEFT", 0), ("CAIRN_YAW_LEFT_MINUS_RIGHT", 1)])
    }
}

impl Json for Encoder {
    fn read(value: &Value) -> Self {
        Encoder(value.constant(&[("CAIRN_ENCODER_PER_OBSERVATION", 0), ("CAIRN_ENCODER_PER_FRAME", 1)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_ENCODER_PER_OBSERVATION", 0), ("CAIRN_ENCODER_PER_FRAME", 1)])
    }
}

impl Json for Loss {
    fn read(value: &Value) -> Self {
        Loss(value.constant(&[("CAIRN_LOSS_NONE", 0), ("CAIRN_LOSS_HUBER", 1), ("CAIRN_LOSS_CAUCHY", 2)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_LOSS_NONE", 0), ("CAIRN_LOSS_HUBER", 1), ("CAIRN_LOSS_CAUCHY", 2)])
    }
}

impl Json for MatchResult {
    fn read(value: &Value) -> Self {
        MatchResult(value.constant(&[("CAIRN_RESULT_MATCHED", 1), ("CAIRN_RESULT_NEW", 2), ("CAIRN_RESULT_REJECTED", 3)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_RESULT_MATCHED", 1), ("CAIRN_RESULT_NEW", 2), ("CAIRN_RESULT_REJECTED", 3)])
    }
}

impl Json for Reason {
    fn read(value: &Value) -> Self {
        Reason(value.constant(&[("CAIRN_REASON_NONE", 0), ("CAIRN_REASON_GATE", 1), ("CAIRN_REASON_BATCH_GATE", 2), ("CAIRN_REASON_NO_IMAGE", 3), ("CAIRN_REASON_NO_PLACE", 4), ("CAIRN_REASON_AMBIGUOUS", 5), ("CAIRN_REASON_NO_ROOM", 6), ("CAIRN_REASON_CONTRADICTED", 7)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_REASON_NONE", 0), ("CAIRN_REASON_GATE", 1), ("CAIRN_REASON_BATCH_GATE", 2), ("CAIRN_REASON_NO_IMAGE", 3), ("CAIRN_REASON_NO_PLACE", 4), ("CAIRN_REASON_AMBIGUOUS", 5), ("CAIRN_REASON_NO_ROOM", 6), ("CAIRN_REASON_CONTRADICTED", 7)])
    }
}

impl Json for StateError {
    fn read(value: &Value) -> Self {
        StateError(value.constant(&[("CAIRN_STATE_ERROR_INVARIANT", 0), ("CAIRN_STATE_ERROR_STANDARD", 1)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_STATE_ERROR_INVARIANT", 0), ("CAIRN_STATE_ERROR_STANDARD", 1)])
    }
}

impl Json for Vehicle {
    fn read(value: &Value) -> Self {
        Vehicle(value.constant(&[("CAIRN_VEHICLE_SPATIAL", 0), ("CAIRN_VEHICLE_PLANAR", 1)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_VEHICLE_SPATIAL", 0), ("CAIRN_VEHICLE_PLANAR", 1)])
    }
}

impl Json for Join {
    fn read(value: &Value) -> Self {
        Join(value.constant(&[("CAIRN_JOIN_AUTO", 0), ("CAIRN_JOIN_DENSE", 1), ("CAIRN_JOIN_SPARSE", 2)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_JOIN_AUTO", 0), ("CAIRN_JOIN_DENSE", 1), ("CAIRN_JOIN_SPARSE", 2)])
    }
}

impl Json for Association {
    fn read(value: &Value) -> Self {
        Association(value.constant(&[("CAIRN_ASSOCIATION_KNOWN", 0), ("CAIRN_ASSOCIATION_NEAREST", 1), ("CAIRN_ASSOCIATION_JOINT", 2)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_ASSOCIATION_KNOWN", 0), ("CAIRN_ASSOCIATION_NEAREST", 1), ("CAIRN_ASSOCIATION_JOINT", 2)])
    }
}

impl Json for Distance {
    fn read(value: &Value) -> Self {
        Distance(value.constant(&[("CAIRN_DISTANCE_MAHALANOBIS", 0), ("CAIRN_DISTANCE_LIKELIHOOD", 1)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_DISTANCE_MAHALANOBIS", 0), ("CAIRN_DISTANCE_LIKELIHOOD", 1)])
    }
}

impl Json for NoiseLearning {
    fn read(value: &Value) -> Self {
        NoiseLearning(value.constant(&[("CAIRN_NOISE_REPORTED", 0), ("CAIRN_NOISE_APPLIED", 1)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_NOISE_REPORTED", 0), ("CAIRN_NOISE_APPLIED", 1)])
    }
}

impl Json for ClosedBy {
    fn read(value: &Value) -> Self {
        ClosedBy(value.constant(&[("CAIRN_CLOSED_BY_NONE", 0), ("CAIRN_CLOSED_BY_CALLER", 1), ("CAIRN_CLOSED_BY_LANDMARKS", 2), ("CAIRN_CLOSED_BY_DISTANCE", 3), ("CAIRN_CLOSED_BY_EXTENT", 4), ("CAIRN_CLOSED_BY_SIGMA", 5), ("CAIRN_CLOSED_BY_FIX", 6)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_CLOSED_BY_NONE", 0), ("CAIRN_CLOSED_BY_CALLER", 1), ("CAIRN_CLOSED_BY_LANDMARKS", 2), ("CAIRN_CLOSED_BY_DISTANCE", 3), ("CAIRN_CLOSED_BY_EXTENT", 4), ("CAIRN_CLOSED_BY_SIGMA", 5), ("CAIRN_CLOSED_BY_FIX", 6)])
    }
}

impl Json for Verdict {
    fn read(value: &Value) -> Self {
        Verdict(value.constant(&[("CAIRN_VERDICT_GOOD", 0), ("CAIRN_VERDICT_DOUBTFUL", 1), ("CAIRN_VERDICT_LOST", 2)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_VERDICT_GOOD", 0), ("CAIRN_VERDICT_DOUBTFUL", 1), ("CAIRN_VERDICT_LOST", 2)])
    }
}

impl Json for Doubts {
    fn read(value: &Value) -> Self {
        Doubts(value.bits(&[("CAIRN_DOUBT_NIS", 1), ("CAIRN_DOUBT_REFUSALS", 2), ("CAIRN_DOUBT_WIDENED", 4), ("CAIRN_DOUBT_SENSOR_NOISE", 8), ("CAIRN_DOUBT_MOTION_NOISE", 16), ("CAIRN_DOUBT_BIAS", 32), ("CAIRN_DOUBT_JUMP", 64), ("CAIRN_DOUBT_LANDMARKS", 128), ("CAIRN_DOUBT_CLOSING", 256), ("CAIRN_DOUBT_BLIND", 512), ("CAIRN_DOUBT_DEFINITE", 1024)]))
    }
    fn write(&self) -> Value {
        Value::from_bits(self.0, &[("CAIRN_DOUBT_NIS", 1), ("CAIRN_DOUBT_REFUSALS", 2), ("CAIRN_DOUBT_WIDENED", 4), ("CAIRN_DOUBT_SENSOR_NOISE", 8), ("CAIRN_DOUBT_MOTION_NOISE", 16), ("CAIRN_DOUBT_BIAS", 32), ("CAIRN_DOUBT_JUMP", 64), ("CAIRN_DOUBT_LANDMARKS", 128), ("CAIRN_DOUBT_CLOSING", 256), ("CAIRN_DOUBT_BLIND", 512), ("CAIRN_DOUBT_DEFINITE", 1024)])
    }
}

impl Json for Systematic {
    fn read(value: &Value) -> Self {
        Systematic(value.constant(&[("CAIRN_SYSTEMATIC_VELOCITY_BIAS", 0), ("CAIRN_SYSTEMATIC_RATE_BIAS", 1), ("CAIRN_SYSTEMATIC_WHEEL_SCALE", 2), ("CAIRN_SYSTEMATIC_MOUNT_SHIFT", 3), ("CAIRN_SYSTEMATIC_MOUNT_TURN", 4), ("CAIRN_SYSTEMATIC_OFFSET", 5)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_SYSTEMATIC_VELOCITY_BIAS", 0), ("CAIRN_SYSTEMATIC_RATE_BIAS", 1), ("CAIRN_SYSTEMATIC_WHEEL_SCALE", 2), ("CAIRN_SYSTEMATIC_MOUNT_SHIFT", 3), ("CAIRN_SYSTEMATIC_MOUNT_TURN", 4), ("CAIRN_SYSTEMATIC_OFFSET", 5)])
    }
}

impl Json for TeamMode {
    fn read(value: &Value) -> Self {
        TeamMode(value.constant(&[("CAIRN_TEAM_MONO", 0), ("CAIRN_TEAM_EO_DIAGONAL", 1), ("CAIRN_TEAM_EO_FULL", 2), ("CAIRN_TEAM_JOINT", 3), ("CAIRN_TEAM_SUBMAPS", 4)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_TEAM_MONO", 0), ("CAIRN_TEAM_EO_DIAGONAL", 1), ("CAIRN_TEAM_EO_FULL", 2), ("CAIRN_TEAM_JOINT", 3), ("CAIRN_TEAM_SUBMAPS", 4)])
    }
}

impl Json for Packet {
    fn read(value: &Value) -> Self {
        Packet(value.constant(&[("CAIRN_PACKET_TAKEN", 1), ("CAIRN_PACKET_WAITING", 2), ("CAIRN_PACKET_REQUEST", 3), ("CAIRN_PACKET_LEAVE", 4), ("CAIRN_PACKET_REPEATED", 5), ("CAIRN_PACKET_OWN", 6), ("CAIRN_PACKET_IGNORED", 7), ("CAIRN_PACKET_UNKNOWN", 8), ("CAIRN_PACKET_PAST", 9), ("CAIRN_PACKET_CONFLICT", 10), ("CAIRN_PACKET_FULL", 11), ("CAIRN_PACKET_FOREIGN", 12), ("CAIRN_PACKET_VERSION", 13), ("CAIRN_PACKET_CUT", 14), ("CAIRN_PACKET_CORRUPT", 15), ("CAIRN_PACKET_NONSENSE", 16), ("CAIRN_PACKET_AHEAD", 17)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_PACKET_TAKEN", 1), ("CAIRN_PACKET_WAITING", 2), ("CAIRN_PACKET_REQUEST", 3), ("CAIRN_PACKET_LEAVE", 4), ("CAIRN_PACKET_REPEATED", 5), ("CAIRN_PACKET_OWN", 6), ("CAIRN_PACKET_IGNORED", 7), ("CAIRN_PACKET_UNKNOWN", 8), ("CAIRN_PACKET_PAST", 9), ("CAIRN_PACKET_CONFLICT", 10), ("CAIRN_PACKET_FULL", 11), ("CAIRN_PACKET_FOREIGN", 12), ("CAIRN_PACKET_VERSION", 13), ("CAIRN_PACKET_CUT", 14), ("CAIRN_PACKET_CORRUPT", 15), ("CAIRN_PACKET_NONSENSE", 16), ("CAIRN_PACKET_AHEAD", 17)])
    }
}

impl Json for Course {
    fn read(value: &Value) -> Self {
        Course(value.constant(&[("CAIRN_COURSE_CIRCLE", 0), ("CAIRN_COURSE_LAPS", 1), ("CAIRN_COURSE_TRAVERSE", 2)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_COURSE_CIRCLE", 0), ("CAIRN_COURSE_LAPS", 1), ("CAIRN_COURSE_TRAVERSE", 2)])
    }
}

impl Json for Terrain {
    fn read(value: &Value) -> Self {
        Terrain(value.constant(&[("CAIRN_TERRAIN_ROLLING", 0), ("CAIRN_TERRAIN_WAVES", 1), ("CAIRN_TERRAIN_FLAT", 2)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_TERRAIN_ROLLING", 0), ("CAIRN_TERRAIN_WAVES", 1), ("CAIRN_TERRAIN_FLAT", 2)])
    }
}

impl Json for Contact {
    fn read(value: &Value) -> Self {
        Contact(value.constant(&[("CAIRN_CONTACT_WHEELS", 0), ("CAIRN_CONTACT_POINT", 1)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_CONTACT_WHEELS", 0), ("CAIRN_CONTACT_POINT", 1)])
    }
}

impl Json for Drive {
    fn read(value: &Value) -> Self {
        Drive(value.constant(&[("CAIRN_DRIVE_TWIST", 0), ("CAIRN_DRIVE_WHEELS_GYRO", 1)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_DRIVE_TWIST", 0), ("CAIRN_DRIVE_WHEELS_GYRO", 1)])
    }
}

impl Json for Accelerometer {
    fn read(value: &Value) -> Self {
        Accelerometer(value.constant(&[("CAIRN_ACCELEROMETER_VELOCITY", 0), ("CAIRN_ACCELEROMETER_ACCELERATION", 1)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_ACCELEROMETER_VELOCITY", 0), ("CAIRN_ACCELEROMETER_ACCELERATION", 1)])
    }
}

impl Json for Stick {
    fn read(value: &Value) -> Self {
        Stick(value.constant(&[("CAIRN_STICK_PER_OBSERVATION", 0), ("CAIRN_STICK_PER_FRAME", 1)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_STICK_PER_OBSERVATION", 0), ("CAIRN_STICK_PER_FRAME", 1)])
    }
}

impl Json for Preset {
    fn read(value: &Value) -> Self {
        Preset(value.constant(&[("CAIRN_PRESET_PAPER", 0), ("CAIRN_PRESET_ROW1", 1), ("CAIRN_PRESET_ROW2", 2), ("CAIRN_PRESET_ROW3", 3), ("CAIRN_PRESET_ROW4", 4)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_PRESET_PAPER", 0), ("CAIRN_PRESET_ROW1", 1), ("CAIRN_PRESET_ROW2", 2), ("CAIRN_PRESET_ROW3", 3), ("CAIRN_PRESET_ROW4", 4)])
    }
}

impl Json for FleetLayout {
    fn read(value: &Value) -> Self {
        FleetLayout(value.constant(&[("CAIRN_FLEET_UNIFORM", 0), ("CAIRN_FLEET_COAST", 1)]))
    }
    fn write(&self) -> Value {
        Value::from_constant(self.0, &[("CAIRN_FLEET_UNIFORM", 0), ("CAIRN_FLEET_COAST", 1)])
    }
}

impl Fields for Pose {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "position" => self.position = Json::read(value),
            "quaternion" => self.quaternion = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("position".into(), self.position.write()),
            ("quaternion".into(), self.quaternion.write()),
        ]
    }
}

impl super::json::Zero for Pose {
    fn zero() -> Self {
        Pose {
            position: super::json::Zero::zero(),
            quaternion: super::json::Zero::zero(),
        }
    }
}

impl Json for Pose {
    fn read(value: &Value) -> Self {
        value.fields_over(<Self as super::json::Zero>::zero())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for Landmark {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "id" => self.id = Json::read(value),
            "observations" => self.observations = Json::read(value),
            "position" => self.position = Json::read(value),
            "covariance" => self.covariance = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("id".into(), self.id.write()),
            ("observations".into(), self.observations.write()),
            ("position".into(), self.position.write()),
            ("covariance".into(), self.covariance.write()),
        ]
    }
}

impl super::json::Zero for Landmark {
    fn zero() -> Self {
        Landmark {
            id: super::json::Zero::zero(),
            observations: super::json::Zero::zero(),
            position: super::json::Zero::zero(),
            covariance: super::json::Zero::zero(),
        }
    }
}

impl Json for Landmark {
    fn read(value: &Value) -> Self {
        value.fields_over(<Self as super::json::Zero>::zero())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for MergeOptions {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "association" => self.association = Json::read(value),
            "gate_probability" => self.gate_probability = Json::read(value),
            "joint_gate_probability" => self.joint_gate_probability = Json::read(value),
            "max_landmarks" => self.max_landmarks = Json::read(value),
            "max_tilt" => self.max_tilt = Json::read(value),
            "has_transform" => self.has_transform = Json::read(value),
            "T_map_other" => self.t_map_other = Json::read(value),
            "covariance" => self.covariance = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("association".into(), self.association.write()),
            ("gate_probability".into(), self.gate_probability.write()),
            ("joint_gate_probability".into(), self.joint_gate_probability.write()),
            ("max_landmarks".into(), self.max_landmarks.write()),
            ("max_tilt".into(), self.max_tilt.write()),
            ("has_transform".into(), self.has_transform.write()),
            ("T_map_other".into(), self.t_map_other.write()),
            ("covariance".into(), self.covariance.write()),
        ]
    }
}

impl Json for MergeOptions {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for MergeReport {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "association" => self.association = Json::read(value),
            "common" => self.common = Json::read(value),
            "added" => self.added = Json::read(value),
            "rows" => self.rows = Json::read(value),
            "distance" => self.distance = Json::read(value),
            "threshold" => self.threshold = Json::read(value),
            "T_map_other" => self.t_map_other = Json::read(value),
            "covariance" => self.covariance = Json::read(value),
            "broken_id" => self.broken_id = Json::read(value),
            "broken_other_id" => self.broken_other_id = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("association".into(), self.association.write()),
            ("common".into(), self.common.write()),
            ("added".into(), self.added.write()),
            ("rows".into(), self.rows.write()),
            ("distance".into(), self.distance.write()),
            ("threshold".into(), self.threshold.write()),
            ("T_map_other".into(), self.t_map_other.write()),
            ("covariance".into(), self.covariance.write()),
            ("broken_id".into(), self.broken_id.write()),
            ("broken_other_id".into(), self.broken_other_id.write()),
        ]
    }
}

impl Json for MergeReport {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for MergedId {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "other_id" => self.other_id = Json::read(value),
            "id" => self.id = Json::read(value),
            "common" => self.common = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("other_id".into(), self.other_id.write()),
            ("id".into(), self.id.write()),
            ("common".into(), self.common.write()),
        ]
    }
}

impl super::json::Zero for MergedId {
    fn zero() -> Self {
        MergedId {
            other_id: super::json::Zero::zero(),
            id: super::json::Zero::zero(),
            common: super::json::Zero::zero(),
        }
    }
}

impl Json for MergedId {
    fn read(value: &Value) -> Self {
        value.fields_over(<Self as super::json::Zero>::zero())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for Wheels {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "yaw_sign" => self.yaw_sign = Json::read(value),
            "radius" => self.radius = Json::read(value),
            "track" => self.track = Json::read(value),
            "rate_sigma" => self.rate_sigma = Json::read(value),
            "slip_sigma" => self.slip_sigma = Json::read(value),
            "lateral_sigma" => self.lateral_sigma = Json::read(value),
            "vertical_sigma" => self.vertical_sigma = Json::read(value),
            "roll_rate_sigma" => self.roll_rate_sigma = Json::read(value),
            "pitch_rate_sigma" => self.pitch_rate_sigma = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("yaw_sign".into(), self.yaw_sign.write()),
            ("radius".into(), self.radius.write()),
            ("track".into(), self.track.write()),
            ("rate_sigma".into(), self.rate_sigma.write()),
            ("slip_sigma".into(), self.slip_sigma.write()),
            ("lateral_sigma".into(), self.lateral_sigma.write()),
            ("vertical_sigma".into(), self.vertical_sigma.write()),
            ("roll_rate_sigma".into(), self.roll_rate_sigma.write()),
            ("pitch_rate_sigma".into(), self.pitch_rate_sigma.write()),
        ]
    }
}

impl Json for Wheels {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for TwistNoise {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "velocity_sigma" => self.velocity_sigma = Json::read(value),
            "rate_sigma" => self.rate_sigma = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("velocity_sigma".into(), self.velocity_sigma.write()),
            ("rate_sigma".into(), self.rate_sigma.write()),
        ]
    }
}

impl Json for TwistNoise {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for StereoHead {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "encoder_mode" => self.encoder_mode = Json::read(value),
            "platform" => self.platform = Json::read(value),
            "stick" => self.stick = Json::read(value),
            "camera_quaternion" => self.camera_quaternion = Json::read(value),
            "range_sigma" => self.range_sigma = Json::read(value),
            "azimuth_sigma" => self.azimuth_sigma = Json::read(value),
            "elevation_sigma" => self.elevation_sigma = Json::read(value),
            "pan_sigma" => self.pan_sigma = Json::read(value),
            "stick_sigma" => self.stick_sigma = Json::read(value),
            "near_range" => self.near_range = Json::read(value),
            "max_elevation" => self.max_elevation = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("encoder_mode".into(), self.encoder_mode.write()),
            ("platform".into(), self.platform.write()),
            ("stick".into(), self.stick.write()),
            ("camera_quaternion".into(), self.camera_quaternion.write()),
            ("range_sigma".into(), self.range_sigma.write()),
            ("azimuth_sigma".into(), self.azimuth_sigma.write()),
            ("elevation_sigma".into(), self.elevation_sigma.write()),
            ("pan_sigma".into(), self.pan_sigma.write()),
            ("stick_sigma".into(), self.stick_sigma.write()),
            ("near_range".into(), self.near_range.write()),
            ("max_elevation".into(), self.max_elevation.write()),
        ]
    }
}

impl Json for StereoHead {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for StereoCamera {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "fu" => self.fu = Json::read(value),
            "fv" => self.fv = Json::read(value),
            "cu" => self.cu = Json::read(value),
            "cv" => self.cv = Json::read(value),
            "baseline" => self.baseline = Json::read(value),
            "T_body_camera" => self.t_body_camera = Json::read(value),
            "sigma" => self.sigma = Json::read(value),
            "near_depth" => self.near_depth = Json::read(value),
            "min_disparity" => self.min_disparity = Json::read(value),
            "min_disparity_sigmas" => self.min_disparity_sigmas = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("fu".into(), self.fu.write()),
            ("fv".into(), self.fv.write()),
            ("cu".into(), self.cu.write()),
            ("cv".into(), self.cv.write()),
            ("baseline".into(), self.baseline.write()),
            ("T_body_camera".into(), self.t_body_camera.write()),
            ("sigma".into(), self.sigma.write()),
            ("near_depth".into(), self.near_depth.write()),
            ("min_disparity".into(), self.min_disparity.write()),
            ("min_disparity_sigmas".into(), self.min_disparity_sigmas.write()),
        ]
    }
}

impl Json for StereoCamera {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for RangeBearing {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "T_body_sensor" => self.t_body_sensor = Json::read(value),
            "range_sigma" => self.range_sigma = Json::read(value),
            "bearing_sigma" => self.bearing_sigma = Json::read(value),
            "near_range" => self.near_range = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("T_body_sensor".into(), self.t_body_sensor.write()),
            ("range_sigma".into(), self.range_sigma.write()),
            ("bearing_sigma".into(), self.bearing_sigma.write()),
            ("near_range".into(), self.near_range.write()),
        ]
    }
}

impl Json for RangeBearing {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for Cartesian {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "T_body_sensor" => self.t_body_sensor = Json::read(value),
            "sigma" => self.sigma = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("T_body_sensor".into(), self.t_body_sensor.write()),
            ("sigma".into(), self.sigma.write()),
        ]
    }
}

impl Json for Cartesian {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for Custom {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "rows" => self.rows = Json::read(value),
            "angle_mask" => self.angle_mask = Json::read(value),
            "relative" => self.relative = Json::read(value),
            "sigma" => self.sigma = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("rows".into(), self.rows.write()),
            ("angle_mask".into(), self.angle_mask.write()),
            ("relative".into(), self.relative.write()),
            ("sigma".into(), self.sigma.write()),
        ]
    }
}

impl Json for Custom {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for Observation {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "id" => self.id = Json::read(value),
            "z" => self.z = Json::read(value),
            "covariance" => self.covariance = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("id".into(), self.id.write()),
            ("z".into(), self.z.write()),
            ("covariance".into(), self.covariance.write()),
        ]
    }
}

impl super::json::Zero for Observation {
    fn zero() -> Self {
        Observation {
            id: super::json::Zero::zero(),
            z: super::json::Zero::zero(),
            covariance: super::json::Zero::zero(),
        }
    }
}

impl Json for Observation {
    fn read(value: &Value) -> Self {
        value.fields_over(<Self as super::json::Zero>::zero())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for Match {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "landmark" => self.landmark = Json::read(value),
            "result" => self.result = Json::read(value),
            "reason" => self.reason = Json::read(value),
            "distance" => self.distance = Json::read(value),
            "threshold" => self.threshold = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("landmark".into(), self.landmark.write()),
            ("result".into(), self.result.write()),
            ("reason".into(), self.reason.write()),
            ("distance".into(), self.distance.write()),
            ("threshold".into(), self.threshold.write()),
        ]
    }
}

impl super::json::Zero for Match {
    fn zero() -> Self {
        Match {
            landmark: super::json::Zero::zero(),
            result: super::json::Zero::zero(),
            reason: super::json::Zero::zero(),
            distance: super::json::Zero::zero(),
            threshold: super::json::Zero::zero(),
        }
    }
}

impl Json for Match {
    fn read(value: &Value) -> Self {
        value.fields_over(<Self as super::json::Zero>::zero())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for FilterOptions {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "vehicle" => self.vehicle = Json::read(value),
            "state_error" => self.state_error = Json::read(value),
            "max_landmarks" => self.max_landmarks = Json::read(value),
            "max_observations" => self.max_observations = Json::read(value),
            "max_sensors" => self.max_sensors = Json::read(value),
            "initial_pose" => self.initial_pose = Json::read(value),
            "initial_covariance" => self.initial_covariance = Json::read(value),
            "iterations" => self.iterations = Json::read(value),
            "noise_learning" => self.noise_learning = Json::read(value),
            "iteration_tolerance" => self.iteration_tolerance = Json::read(value),
            "gate_probability" => self.gate_probability = Json::read(value),
            "batch_gate_probability" => self.batch_gate_probability = Json::read(value),
            "error_persistence" => self.error_persistence = Json::read(value),
            "association" => self.association = Json::read(value),
            "association_distance" => self.association_distance = Json::read(value),
            "association_nodes" => self.association_nodes = Json::read(value),
            "deferred_sightings" => self.deferred_sightings = Json::read(value),
            "deferred_frames" => self.deferred_frames = Json::read(value),
            "missed_frames" => self.missed_frames = Json::read(value),
            "new_probability" => self.new_probability = Json::read(value),
            "submap_landmarks" => self.submap_landmarks = Json::read(value),
            "join" => self.join = Json::read(value),
            "join_loss" => self.join_loss = Json::read(value),
            "trajectory_poses" => self.trajectory_poses = Json::read(value),
            "join_loss_width" => self.join_loss_width = Json::read(value),
            "submap_distance" => self.submap_distance = Json::read(value),
            "submap_extent" => self.submap_extent = Json::read(value),
            "submap_sigma" => self.submap_sigma = Json::read(value),
            "velocity_bias_sigma" => self.velocity_bias_sigma = Json::read(value),
            "velocity_bias_walk" => self.velocity_bias_walk = Json::read(value),
            "rate_bias_sigma" => self.rate_bias_sigma = Json::read(value),
            "rate_bias_walk" => self.rate_bias_walk = Json::read(value),
            "wheel_scale_sigma" => self.wheel_scale_sigma = Json::read(value),
            "wheel_scale_walk" => self.wheel_scale_walk = Json::read(value),
            "max_sensor_errors" => self.max_sensor_errors = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("vehicle".into(), self.vehicle.write()),
            ("state_error".into(), self.state_error.write()),
            ("max_landmarks".into(), self.max_landmarks.write()),
            ("max_observations".into(), self.max_observations.write()),
            ("max_sensors".into(), self.max_sensors.write()),
            ("initial_pose".into(), self.initial_pose.write()),
            ("initial_covariance".into(), self.initial_covariance.write()),
            ("iterations".into(), self.iterations.write()),
            ("noise_learning".into(), self.noise_learning.write()),
            ("iteration_tolerance".into(), self.iteration_tolerance.write()),
            ("gate_probability".into(), self.gate_probability.write()),
            ("batch_gate_probability".into(), self.batch_gate_probability.write()),
            ("error_persistence".into(), self.error_persistence.write()),
            ("association".into(), self.association.write()),
            ("association_distance".into(), self.association_distance.write()),
            ("association_nodes".into(), self.association_nodes.write()),
            ("deferred_sightings".into(), self.deferred_sightings.write()),
            ("deferred_frames".into(), self.deferred_frames.write()),
            ("missed_frames".into(), self.missed_frames.write()),
            ("new_probability".into(), self.new_probability.write()),
            ("submap_landmarks".into(), self.submap_landmarks.write()),
            ("join".into(), self.join.write()),
            ("join_loss".into(), self.join_loss.write()),
            ("trajectory_poses".into(), self.trajectory_poses.write()),
            ("join_loss_width".into(), self.join_loss_width.write()),
            ("submap_distance".into(), self.submap_distance.write()),
            ("submap_extent".into(), self.submap_extent.write()),
            ("submap_sigma".into(), self.submap_sigma.write()),
            ("velocity_bias_sigma".into(), self.velocity_bias_sigma.write()),
            ("velocity_bias_walk".into(), self.velocity_bias_walk.write()),
            ("rate_bias_sigma".into(), self.rate_bias_sigma.write()),
            ("rate_bias_walk".into(), self.rate_bias_walk.write()),
            ("wheel_scale_sigma".into(), self.wheel_scale_sigma.write()),
            ("wheel_scale_walk".into(), self.wheel_scale_walk.write()),
            ("max_sensor_errors".into(), self.max_sensor_errors.write()),
        ]
    }
}

impl Json for FilterOptions {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for ClosingReport {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "status" => self.status = Json::read(value),
            "reason" => self.reason = Json::read(value),
            "submaps" => self.submaps = Json::read(value),
            "landmarks" => self.landmarks = Json::read(value),
            "landmarks_new" => self.landmarks_new = Json::read(value),
            "landmarks_fused" => self.landmarks_fused = Json::read(value),
            "landmarks_refused" => self.landmarks_refused = Json::read(value),
            "landmarks_ambiguous" => self.landmarks_ambiguous = Json::read(value),
            "rows" => self.rows = Json::read(value),
            "distance" => self.distance = Json::read(value),
            "threshold" => self.threshold = Json::read(value),
            "moved_max" => self.moved_max = Json::read(value),
            "moved_rms" => self.moved_rms = Json::read(value),
            "widened_position" => self.widened_position = Json::read(value),
            "widened_attitude" => self.widened_attitude = Json::read(value),
            "association_nodes" => self.association_nodes = Json::read(value),
            "association_exhausted" => self.association_exhausted = Json::read(value),
            "relinearised" => self.relinearised = Json::read(value),
            "refactored" => self.refactored = Json::read(value),
            "iterations" => self.iterations = Json::read(value),
            "seconds" => self.seconds = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("status".into(), self.status.write()),
            ("reason".into(), self.reason.write()),
            ("submaps".into(), self.submaps.write()),
            ("landmarks".into(), self.landmarks.write()),
            ("landmarks_new".into(), self.landmarks_new.write()),
            ("landmarks_fused".into(), self.landmarks_fused.write()),
            ("landmarks_refused".into(), self.landmarks_refused.write()),
            ("landmarks_ambiguous".into(), self.landmarks_ambiguous.write()),
            ("rows".into(), self.rows.write()),
            ("distance".into(), self.distance.write()),
            ("threshold".into(), self.threshold.write()),
            ("moved_max".into(), self.moved_max.write()),
            ("moved_rms".into(), self.moved_rms.write()),
            ("widened_position".into(), self.widened_position.write()),
            ("widened_attitude".into(), self.widened_attitude.write()),
            ("association_nodes".into(), self.association_nodes.write()),
            ("association_exhausted".into(), self.association_exhausted.write()),
            ("relinearised".into(), self.relinearised.write()),
            ("refactored".into(), self.refactored.write()),
            ("iterations".into(), self.iterations.write()),
        ]
    }
}

impl Json for ClosingReport {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for UpdateReport {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "matched" => self.matched = Json::read(value),
            "placed" => self.placed = Json::read(value),
            "placed_again" => self.placed_again = Json::read(value),
            "rejected" => self.rejected = Json::read(value),
            "deferred" => self.deferred = Json::read(value),
            "removed" => self.removed = Json::read(value),
            "rows" => self.rows = Json::read(value),
            "nis" => self.nis = Json::read(value),
            "nis_lower" => self.nis_lower = Json::read(value),
            "nis_upper" => self.nis_upper = Json::read(value),
            "widened_position" => self.widened_position = Json::read(value),
            "widened_attitude" => self.widened_attitude = Json::read(value),
            "iterations" => self.iterations = Json::read(value),
            "association_nodes" => self.association_nodes = Json::read(value),
            "association_exhausted" => self.association_exhausted = Json::read(value),
            "association_seconds" => self.association_seconds = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("matched".into(), self.matched.write()),
            ("placed".into(), self.placed.write()),
            ("placed_again".into(), self.placed_again.write()),
            ("rejected".into(), self.rejected.write()),
            ("deferred".into(), self.deferred.write()),
            ("removed".into(), self.removed.write()),
            ("rows".into(), self.rows.write()),
            ("nis".into(), self.nis.write()),
            ("nis_lower".into(), self.nis_lower.write()),
            ("nis_upper".into(), self.nis_upper.write()),
            ("widened_position".into(), self.widened_position.write()),
            ("widened_attitude".into(), self.widened_attitude.write()),
            ("iterations".into(), self.iterations.write()),
            ("association_nodes".into(), self.association_nodes.write()),
            ("association_exhausted".into(), self.association_exhausted.write()),
        ]
    }
}

impl Json for UpdateReport {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for Health {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "verdict" => self.verdict = Json::read(value),
            "reasons" => self.reasons = Json::read(value),
            "blind_directions" => self.blind_directions = Json::read(value),
            "contradicting" => self.contradicting = Json::read(value),
            "updates" => self.updates = Json::read(value),
            "good_share" => self.good_share = Json::read(value),
            "doubtful_share" => self.doubtful_share = Json::read(value),
            "lost_share" => self.lost_share = Json::read(value),
            "nis_per_row" => self.nis_per_row = Json::read(value),
            "nis_lower" => self.nis_lower = Json::read(value),
            "nis_upper" => self.nis_upper = Json::read(value),
            "refused_share" => self.refused_share = Json::read(value),
            "widenings" => self.widenings = Json::read(value),
            "last_widening" => self.last_widening = Json::read(value),
            "motion_scale" => self.motion_scale = Json::read(value),
            "motion_scale_sigma" => self.motion_scale_sigma = Json::read(value),
            "bias_sigmas" => self.bias_sigmas = Json::read(value),
            "jump_sigmas" => self.jump_sigmas = Json::read(value),
            "pose_pivot" => self.pose_pivot = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("verdict".into(), self.verdict.write()),
            ("reasons".into(), self.reasons.write()),
            ("blind_directions".into(), self.blind_directions.write()),
            ("contradicting".into(), self.contradicting.write()),
            ("updates".into(), self.updates.write()),
            ("good_share".into(), self.good_share.write()),
            ("doubtful_share".into(), self.doubtful_share.write()),
            ("lost_share".into(), self.lost_share.write()),
            ("nis_per_row".into(), self.nis_per_row.write()),
            ("nis_lower".into(), self.nis_lower.write()),
            ("nis_upper".into(), self.nis_upper.write()),
            ("refused_share".into(), self.refused_share.write()),
            ("widenings".into(), self.widenings.write()),
            ("last_widening".into(), self.last_widening.write()),
            ("motion_scale".into(), self.motion_scale.write()),
            ("motion_scale_sigma".into(), self.motion_scale_sigma.write()),
            ("bias_sigmas".into(), self.bias_sigmas.write()),
            ("jump_sigmas".into(), self.jump_sigmas.write()),
            ("pose_pivot".into(), self.pose_pivot.write()),
        ]
    }
}

impl Json for Health {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for SensorHealth {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "compared" => self.compared = Json::read(value),
            "refused" => self.refused = Json::read(value),
            "nis_per_row" => self.nis_per_row = Json::read(value),
            "nis_lower" => self.nis_lower = Json::read(value),
            "nis_upper" => self.nis_upper = Json::read(value),
            "scale" => self.scale = Json::read(value),
            "scale_sigma" => self.scale_sigma = Json::read(value),
            "persistence" => self.persistence = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("compared".into(), self.compared.write()),
            ("refused".into(), self.refused.write()),
            ("nis_per_row".into(), self.nis_per_row.write()),
            ("nis_lower".into(), self.nis_lower.write()),
            ("nis_upper".into(), self.nis_upper.write()),
            ("scale".into(), self.scale.write()),
            ("scale_sigma".into(), self.scale_sigma.write()),
            ("persistence".into(), self.persistence.write()),
        ]
    }
}

impl Json for SensorHealth {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for Calibration {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "mount_shift_sigma" => self.mount_shift_sigma = Json::read(value),
            "mount_shift_walk" => self.mount_shift_walk = Json::read(value),
            "mount_turn_sigma" => self.mount_turn_sigma = Json::read(value),
            "mount_turn_walk" => self.mount_turn_walk = Json::read(value),
            "offset_sigma" => self.offset_sigma = Json::read(value),
            "offset_walk" => self.offset_walk = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("mount_shift_sigma".into(), self.mount_shift_sigma.write()),
            ("mount_shift_walk".into(), self.mount_shift_walk.write()),
            ("mount_turn_sigma".into(), self.mount_turn_sigma.write()),
            ("mount_turn_walk".into(), self.mount_turn_walk.write()),
            ("offset_sigma".into(), self.offset_sigma.write()),
            ("offset_walk".into(), self.offset_walk.write()),
        ]
    }
}

impl Json for Calibration {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for SystematicError {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "kind" => self.kind = Json::read(value),
            "sensor" => self.sensor = Json::read(value),
            "component" => self.component = Json::read(value),
            "value" => self.value = Json::read(value),
            "sigma" => self.sigma = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("kind".into(), self.kind.write()),
            ("sensor".into(), self.sensor.write()),
            ("component".into(), self.component.write()),
            ("value".into(), self.value.write()),
            ("sigma".into(), self.sigma.write()),
        ]
    }
}

impl super::json::Zero for SystematicError {
    fn zero() -> Self {
        SystematicError {
            kind: super::json::Zero::zero(),
            sensor: super::json::Zero::zero(),
            component: super::json::Zero::zero(),
            value: super::json::Zero::zero(),
            sigma: super::json::Zero::zero(),
        }
    }
}

impl Json for SystematicError {
    fn read(value: &Value) -> Self {
        value.fields_over(<Self as super::json::Zero>::zero())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for TeamOptions {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "mode" => self.mode = Json::read(value),
            "vehicle" => self.vehicle = Json::read(value),
            "max_vehicles" => self.max_vehicles = Json::read(value),
            "baseline" => self.baseline = Json::read(value),
            "max_lag" => self.max_lag = Json::read(value),
            "time_tolerance" => self.time_tolerance = Json::read(value),
            "max_jump" => self.max_jump = Json::read(value),
            "max_waiting" => self.max_waiting = Json::read(value),
            "history" => self.history = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("mode".into(), self.mode.write()),
            ("vehicle".into(), self.vehicle.write()),
            ("max_vehicles".into(), self.max_vehicles.write()),
            ("baseline".into(), self.baseline.write()),
            ("max_lag".into(), self.max_lag.write()),
            ("time_tolerance".into(), self.time_tolerance.write()),
            ("max_jump".into(), self.max_jump.write()),
            ("max_waiting".into(), self.max_waiting.write()),
            ("history".into(), self.history.write()),
        ]
    }
}

impl Json for TeamOptions {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for TeamReport {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "unsettled" => self.unsettled = Json::read(value),
            "interrupted" => self.interrupted = Json::read(value),
            "sent" => self.sent = Json::read(value),
            "resent" => self.resent = Json::read(value),
            "requested" => self.requested = Json::read(value),
            "received" => self.received = Json::read(value),
            "taken" => self.taken = Json::read(value),
            "reordered" => self.reordered = Json::read(value),
            "repeated" => self.repeated = Json::read(value),
            "own" => self.own = Json::read(value),
            "ignored" => self.ignored = Json::read(value),
            "unknown" => self.unknown = Json::read(value),
            "past" => self.past = Json::read(value),
            "ahead" => self.ahead = Json::read(value),
            "conflict" => self.conflict = Json::read(value),
            "full" => self.full = Json::read(value),
            "foreign" => self.foreign = Json::read(value),
            "version" => self.version = Json::read(value),
            "cut" => self.cut = Json::read(value),
            "corrupt" => self.corrupt = Json::read(value),
            "nonsense" => self.nonsense = Json::read(value),
            "lost" => self.lost = Json::read(value),
            "matched" => self.matched = Json::read(value),
            "placed" => self.placed = Json::read(value),
            "rejected" => self.rejected = Json::read(value),
            "sightings_used" => self.sightings_used = Json::read(value),
            "sightings_refused" => self.sightings_refused = Json::read(value),
            "vehicles_found" => self.vehicles_found = Json::read(value),
            "failed" => self.failed = Json::read(value),
            "scored" => self.scored = Json::read(value),
            "scored_nees" => self.scored_nees = Json::read(value),
            "position_rmse" => self.position_rmse = Json::read(value),
            "anees_per_dof" => self.anees_per_dof = Json::read(value),
            "claimed_improvement" => self.claimed_improvement = Json::read(value),
            "true_improvement" => self.true_improvement = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("unsettled".into(), self.unsettled.write()),
            ("interrupted".into(), self.interrupted.write()),
            ("sent".into(), self.sent.write()),
            ("resent".into(), self.resent.write()),
            ("requested".into(), self.requested.write()),
            ("received".into(), self.received.write()),
            ("taken".into(), self.taken.write()),
            ("reordered".into(), self.reordered.write()),
            ("repeated".into(), self.repeated.write()),
            ("own".into(), self.own.write()),
            ("ignored".into(), self.ignored.write()),
            ("unknown".into(), self.unknown.write()),
            ("past".into(), self.past.write()),
            ("ahead".into(), self.ahead.write()),
            ("conflict".into(), self.conflict.write()),
            ("full".into(), self.full.write()),
            ("foreign".into(), self.foreign.write()),
            ("version".into(), self.version.write()),
            ("cut".into(), self.cut.write()),
            ("corrupt".into(), self.corrupt.write()),
            ("nonsense".into(), self.nonsense.write()),
            ("lost".into(), self.lost.write()),
            ("matched".into(), self.matched.write()),
            ("placed".into(), self.placed.write()),
            ("rejected".into(), self.rejected.write()),
            ("sightings_used".into(), self.sightings_used.write()),
            ("sightings_refused".into(), self.sightings_refused.write()),
            ("vehicles_found".into(), self.vehicles_found.write()),
            ("failed".into(), self.failed.write()),
            ("scored".into(), self.scored.write()),
            ("scored_nees".into(), self.scored_nees.write()),
            ("position_rmse".into(), self.position_rmse.write()),
            ("anees_per_dof".into(), self.anees_per_dof.write()),
            ("claimed_improvement".into(), self.claimed_improvement.write()),
            ("true_improvement".into(), self.true_improvement.write()),
        ]
    }
}

impl Json for TeamReport {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for WorldOptions {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "course" => self.course = Json::read(value),
            "seed" => self.seed = Json::read(value),
            "landmarks" => self.landmarks = Json::read(value),
            "terrain" => self.terrain = Json::read(value),
            "contact" => self.contact = Json::read(value),
            "drive" => self.drive = Json::read(value),
            "accelerometer" => self.accelerometer = Json::read(value),
            "stick_noise" => self.stick_noise = Json::read(value),
            "observe_at_start" => self.observe_at_start = Json::read(value),
            "traverse_closed" => self.traverse_closed = Json::read(value),
            "speed" => self.speed = Json::read(value),
            "laps" => self.laps = Json::read(value),
            "centre" => self.centre = Json::read(value),
            "radius" => self.radius = Json::read(value),
            "start_azimuth" => self.start_azimuth = Json::read(value),
            "round_length" => self.round_length = Json::read(value),
            "round_variation" => self.round_variation = Json::read(value),
            "strip" => self.strip = Json::read(value),
            "landmark_area" => self.landmark_area = Json::read(value),
            "landmark_height" => self.landmark_height = Json::read(value),
            "max_slope" => self.max_slope = Json::read(value),
            "wavelength" => self.wavelength = Json::read(value),
            "start_height" => self.start_height = Json::read(value),
            "wheel_radius" => self.wheel_radius = Json::read(value),
            "track" => self.track = Json::read(value),
            "wheelbase" => self.wheelbase = Json::read(value),
            "velocity_sigma" => self.velocity_sigma = Json::read(value),
            "rate_sigma" => self.rate_sigma = Json::read(value),
            "gravity" => self.gravity = Json::read(value),
            "wheel_rate_sigma" => self.wheel_rate_sigma = Json::read(value),
            "wheel_slip_sigma" => self.wheel_slip_sigma = Json::read(value),
            "lateral_sigma" => self.lateral_sigma = Json::read(value),
            "vertical_sigma" => self.vertical_sigma = Json::read(value),
            "imu_period" => self.imu_period = Json::read(value),
            "motion_period" => self.motion_period = Json::read(value),
            "frame_period" => self.frame_period = Json::read(value),
            "range_sigma" => self.range_sigma = Json::read(value),
            "azimuth_sigma" => self.azimuth_sigma = Json::read(value),
            "stick_sigma" => self.stick_sigma = Json::read(value),
            "image_sigma" => self.image_sigma = Json::read(value),
            "near_range" => self.near_range = Json::read(value),
            "far_range" => self.far_range = Json::read(value),
            "half_azimuth" => self.half_azimuth = Json::read(value),
            "pan_amplitude" => self.pan_amplitude = Json::read(value),
            "pan_period" => self.pan_period = Json::read(value),
            "stick_amplitude" => self.stick_amplitude = Json::read(value),
            "stick_period" => self.stick_period = Json::read(value),
            "platform" => self.platform = Json::read(value),
            "stick" => self.stick = Json::read(value),
            "velocity_bias" => self.velocity_bias = Json::read(value),
            "rate_bias" => self.rate_bias = Json::read(value),
            "wheel_scale" => self.wheel_scale = Json::read(value),
            "mount_turn" => self.mount_turn = Json::read(value),
            "mount_shift" => self.mount_shift = Json::read(value),
            "value_offset" => self.value_offset = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("course".into(), self.course.write()),
            ("seed".into(), self.seed.write()),
            ("landmarks".into(), self.landmarks.write()),
            ("terrain".into(), self.terrain.write()),
            ("contact".into(), self.contact.write()),
            ("drive".into(), self.drive.write()),
            ("accelerometer".into(), self.accelerometer.write()),
            ("stick_noise".into(), self.stick_noise.write()),
            ("observe_at_start".into(), self.observe_at_start.write()),
            ("traverse_closed".into(), self.traverse_closed.write()),
            ("speed".into(), self.speed.write()),
            ("laps".into(), self.laps.write()),
            ("centre".into(), self.centre.write()),
            ("radius".into(), self.radius.write()),
            ("start_azimuth".into(), self.start_azimuth.write()),
            ("round_length".into(), self.round_length.write()),
            ("round_variation".into(), self.round_variation.write()),
            ("strip".into(), self.strip.write()),
            ("landmark_area".into(), self.landmark_area.write()),
            ("landmark_height".into(), self.landmark_height.write()),
            ("max_slope".into(), self.max_slope.write()),
            ("wavelength".into(), self.wavelength.write()),
            ("start_height".into(), self.start_height.write()),
            ("wheel_radius".into(), self.wheel_radius.write()),
            ("track".into(), self.track.write()),
            ("wheelbase".into(), self.wheelbase.write()),
            ("velocity_sigma".into(), self.velocity_sigma.write()),
            ("rate_sigma".into(), self.rate_sigma.write()),
            ("gravity".into(), self.gravity.write()),
            ("wheel_rate_sigma".into(), self.wheel_rate_sigma.write()),
            ("wheel_slip_sigma".into(), self.wheel_slip_sigma.write()),
            ("lateral_sigma".into(), self.lateral_sigma.write()),
            ("vertical_sigma".into(), self.vertical_sigma.write()),
            ("imu_period".into(), self.imu_period.write()),
            ("motion_period".into(), self.motion_period.write()),
            ("frame_period".into(), self.frame_period.write()),
            ("range_sigma".into(), self.range_sigma.write()),
            ("azimuth_sigma".into(), self.azimuth_sigma.write()),
            ("stick_sigma".into(), self.stick_sigma.write()),
            ("image_sigma".into(), self.image_sigma.write()),
            ("near_range".into(), self.near_range.write()),
            ("far_range".into(), self.far_range.write()),
            ("half_azimuth".into(), self.half_azimuth.write()),
            ("pan_amplitude".into(), self.pan_amplitude.write()),
            ("pan_period".into(), self.pan_period.write()),
            ("stick_amplitude".into(), self.stick_amplitude.write()),
            ("stick_period".into(), self.stick_period.write()),
            ("platform".into(), self.platform.write()),
            ("stick".into(), self.stick.write()),
            ("velocity_bias".into(), self.velocity_bias.write()),
            ("rate_bias".into(), self.rate_bias.write()),
            ("wheel_scale".into(), self.wheel_scale.write()),
            ("mount_turn".into(), self.mount_turn.write()),
            ("mount_shift".into(), self.mount_shift.write()),
            ("value_offset".into(), self.value_offset.write()),
        ]
    }
}

impl Json for WorldOptions {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for WorldMotion {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "dt" => self.dt = Json::read(value),
            "velocity" => self.velocity = Json::read(value),
            "rate" => self.rate = Json::read(value),
            "wheels" => self.wheels = Json::read(value),
            "true_velocity" => self.true_velocity = Json::read(value),
            "true_rate" => self.true_rate = Json::read(value),
            "true_wheels" => self.true_wheels = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("dt".into(), self.dt.write()),
            ("velocity".into(), self.velocity.write()),
            ("rate".into(), self.rate.write()),
            ("wheels".into(), self.wheels.write()),
            ("true_velocity".into(), self.true_velocity.write()),
            ("true_rate".into(), self.true_rate.write()),
            ("true_wheels".into(), self.true_wheels.write()),
        ]
    }
}

impl super::json::Zero for WorldMotion {
    fn zero() -> Self {
        WorldMotion {
            dt: super::json::Zero::zero(),
            velocity: super::json::Zero::zero(),
            rate: super::json::Zero::zero(),
            wheels: super::json::Zero::zero(),
            true_velocity: super::json::Zero::zero(),
            true_rate: super::json::Zero::zero(),
            true_wheels: super::json::Zero::zero(),
        }
    }
}

impl Json for WorldMotion {
    fn read(value: &Value) -> Self {
        value.fields_over(<Self as super::json::Zero>::zero())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for WorldStep {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "number" => self.number = Json::read(value),
            "time" => self.time = Json::read(value),
            "truth" => self.truth = Json::read(value),
            "velocity_sigma" => self.velocity_sigma = Json::read(value),
            "rate_sigma" => self.rate_sigma = Json::read(value),
            "pan" => self.pan = Json::read(value),
            "stick" => self.stick = Json::read(value),
            "motion_count" => self.motion_count = Json::read(value),
            "observation_count" => self.observation_count = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("number".into(), self.number.write()),
            ("time".into(), self.time.write()),
            ("truth".into(), self.truth.write()),
            ("velocity_sigma".into(), self.velocity_sigma.write()),
            ("rate_sigma".into(), self.rate_sigma.write()),
            ("pan".into(), self.pan.write()),
            ("stick".into(), self.stick.write()),
            ("motion_count".into(), self.motion_count.write()),
            ("observation_count".into(), self.observation_count.write()),
        ]
    }
}

impl Json for WorldStep {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for FleetOptions {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "layout" => self.layout = Json::read(value),
            "seed" => self.seed = Json::read(value),
            "vehicles" => self.vehicles = Json::read(value),
            "features" => self.features = Json::read(value),
            "area" => self.area = Json::read(value),
            "separation" => self.separation = Json::read(value),
            "course_length" => self.course_length = Json::read(value),
            "duration" => self.duration = Json::read(value),
            "period" => self.period = Json::read(value),
            "radar_range" => self.radar_range = Json::read(value),
            "range_sigma" => self.range_sigma = Json::read(value),
            "bearing_sigma" => self.bearing_sigma = Json::read(value),
            "speed_sigma" => self.speed_sigma = Json::read(value),
            "rate_sigma" => self.rate_sigma = Json::read(value),
            "coast_distance" => self.coast_distance = Json::read(value),
            "coast_relief" => self.coast_relief = Json::read(value),
            "coast_strip" => self.coast_strip = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("layout".into(), self.layout.write()),
            ("seed".into(), self.seed.write()),
            ("vehicles".into(), self.vehicles.write()),
            ("features".into(), self.features.write()),
            ("area".into(), self.area.write()),
            ("separation".into(), self.separation.write()),
            ("course_length".into(), self.course_length.write()),
            ("duration".into(), self.duration.write()),
            ("period".into(), self.period.write()),
            ("radar_range".into(), self.radar_range.write()),
            ("range_sigma".into(), self.range_sigma.write()),
            ("bearing_sigma".into(), self.bearing_sigma.write()),
            ("speed_sigma".into(), self.speed_sigma.write()),
            ("rate_sigma".into(), self.rate_sigma.write()),
            ("coast_distance".into(), self.coast_distance.write()),
            ("coast_relief".into(), self.coast_relief.write()),
            ("coast_strip".into(), self.coast_strip.write()),
        ]
    }
}

impl Json for FleetOptions {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for FleetSighting {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "id" => self.id = Json::read(value),
            "range" => self.range = Json::read(value),
            "bearing" => self.bearing = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("id".into(), self.id.write()),
            ("range".into(), self.range.write()),
            ("bearing".into(), self.bearing.write()),
        ]
    }
}

impl super::json::Zero for FleetSighting {
    fn zero() -> Self {
        FleetSighting {
            id: super::json::Zero::zero(),
            range: super::json::Zero::zero(),
            bearing: super::json::Zero::zero(),
        }
    }
}

impl Json for FleetSighting {
    fn read(value: &Value) -> Self {
        value.fields_over(<Self as super::json::Zero>::zero())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for FleetVehicle {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "speed" => self.speed = Json::read(value),
            "rate" => self.rate = Json::read(value),
            "x" => self.x = Json::read(value),
            "y" => self.y = Json::read(value),
            "heading" => self.heading = Json::read(value),
            "feature_count" => self.feature_count = Json::read(value),
            "vehicle_count" => self.vehicle_count = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("speed".into(), self.speed.write()),
            ("rate".into(), self.rate.write()),
            ("x".into(), self.x.write()),
            ("y".into(), self.y.write()),
            ("heading".into(), self.heading.write()),
            ("feature_count".into(), self.feature_count.write()),
            ("vehicle_count".into(), self.vehicle_count.write()),
        ]
    }
}

impl super::json::Zero for FleetVehicle {
    fn zero() -> Self {
        FleetVehicle {
            speed: super::json::Zero::zero(),
            rate: super::json::Zero::zero(),
            x: super::json::Zero::zero(),
            y: super::json::Zero::zero(),
            heading: super::json::Zero::zero(),
            feature_count: super::json::Zero::zero(),
            vehicle_count: super::json::Zero::zero(),
        }
    }
}

impl Json for FleetVehicle {
    fn read(value: &Value) -> Self {
        value.fields_over(<Self as super::json::Zero>::zero())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl Fields for FleetStep {
    fn set(&mut self, name: &str, value: &Value) -> bool {
        match name {
            "number" => self.number = Json::read(value),
            "time" => self.time = Json::read(value),
            "dt" => self.dt = Json::read(value),
            "vehicle_count" => self.vehicle_count = Json::read(value),
            _ => return false,
        }
        true
    }
    fn get(&self) -> Vec<(String, Value)> {
        vec![
            ("number".into(), self.number.write()),
            ("time".into(), self.time.write()),
            ("dt".into(), self.dt.write()),
            ("vehicle_count".into(), self.vehicle_count.write()),
        ]
    }
}

impl Json for FleetStep {
    fn read(value: &Value) -> Self {
        value.fields_over(Self::default())
    }
    fn write(&self) -> Value {
        Value::Object(self.get())
    }
}

impl super::json::Zero for Status {
    fn zero() -> Self {
        Status(0)
    }
}

impl super::json::Zero for MapForm {
    fn zero() -> Self {
        MapForm(0)
    }
}

impl super::json::Zero for MergeBy {
    fn zero() -> Self {
        MergeBy(0)
    }
}

impl super::json::Zero for Yaw {
    fn zero() -> Self {
        Yaw(0)
    }
}

impl super::json::Zero for Encoder {
    fn zero() -> Self {
        Encoder(0)
    }
}

impl super::json::Zero for Loss {
    fn zero() -> Self {
        Loss(0)
    }
}

impl super::json::Zero for MatchResult {
    fn zero() -> Self {
        MatchResult(0)
    }
}

impl super::json::Zero for Reason {
    fn zero() -> Self {
        Reason(0)
    }
}

impl super::json::Zero for StateError {
    fn zero() -> Self {
        StateError(0)
    }
}

impl super::json::Zero for Vehicle {
    fn zero() -> Self {
        Vehicle(0)
    }
}

impl super::json::Zero for Join {
    fn zero() -> Self {
        Join(0)
    }
}

impl super::json::Zero for Association {
    fn zero() -> Self {
        Association(0)
    }
}

impl super::json::Zero for Distance {
    fn zero() -> Self {
        Distance(0)
    }
}

impl super::json::Zero for NoiseLearning {
    fn zero() -> Self {
        NoiseLearning(0)
    }
}

impl super::json::Zero for ClosedBy {
    fn zero() -> Self {
        ClosedBy(0)
    }
}

impl super::json::Zero for Verdict {
    fn zero() -> Self {
        Verdict(0)
    }
}

impl super::json::Zero for Doubts {
    fn zero() -> Self {
        Doubts(0)
    }
}

impl super::json::Zero for Systematic {
    fn zero() -> Self {
        Systematic(0)
    }
}

impl super::json::Zero for TeamMode {
    fn zero() -> Self {
        TeamMode(0)
    }
}

impl super::json::Zero for Packet {
    fn zero() -> Self {
        Packet(0)
    }
}

impl super::json::Zero for Course {
    fn zero() -> Self {
        Course(0)
    }
}

impl super::json::Zero for Terrain {
    fn zero() -> Self {
        Terrain(0)
    }
}

impl super::json::Zero for Contact {
    fn zero() -> Self {
        Contact(0)
    }
}

impl super::json::Zero for Drive {
    fn zero() -> Self {
        Drive(0)
    }
}

impl super::json::Zero for Accelerometer {
    fn zero() -> Self {
        Accelerometer(0)
    }
}

impl super::json::Zero for Stick {
    fn zero() -> Self {
        Stick(0)
    }
}

impl super::json::Zero for Preset {
    fn zero() -> Self {
        Preset(0)
    }
}

impl super::json::Zero for FleetLayout {
    fn zero() -> Self {
        FleetLayout(0)
    }
}
