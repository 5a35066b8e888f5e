/* SPDX-License-Identifier: BSD-3-Clause */
#include "call.hpp"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

namespace conformance {

/* --- values --- */

namespace {

bool is_name(const json& value) {
  return value.is_string() && value.get_ref<const std::string&>().rfind('$', 0) == 0;
}

int64_t constant(const std::string& name) {
  const auto found = all_constants().find(name);
  if (found == all_constants().end()) throw Failure(name + " is no constant");
  return found->second;
}

}  // namespace

double read_double(const json& from) {
  if (from.is_number()) return from.get<double>();
  const std::string text = from.is_string() ? from.get<std::string>() : "";
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (text == "inf") return std::numeric_limits<double>::infinity();
  if (text == "-inf") return -std::numeric_limits<double>::infinity();
  if (text.size() != 17 || text[0] != 'x') throw Failure(from.dump() + " is no double");
  const uint64_t bits = std::stoull(text.substr(1), nullptr, 16);
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

int64_t read_signed(const json& from) {
  if (from.is_boolean()) return from.get<bool>() ? 1 : 0;
  if (from.is_number_integer()) return from.get<int64_t>();
  if (from.is_string()) return constant(from.get<std::string>());
  throw Failure(from.dump() + " is no integer");
}

uint64_t read_unsigned(const json& from) {
  if (from.is_number_unsigned()) return from.get<uint64_t>();
  if (from.is_array()) {  // bits
    uint64_t bits = 0;
    for (const json& name : from) bits |= read_unsigned(name);
    return bits;
  }
  if (!from.is_string()) throw Failure(from.dump() + " is no number without a sign");
  const std::string text = from.get<std::string>();
  if (text.rfind("CAIRN_", 0) == 0) return static_cast<uint64_t>(constant(text));
  if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos) throw Failure(text + " is no number");
  return std::stoull(text);
}

json write_double(double value) {
  if (std::isnan(value)) return "nan";
  uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  char text[18];
  std::snprintf(text, sizeof text, "x%016" PRIx64, bits);
  return text;
}

json write_constant(int64_t value, const Constants& names) {
  const auto found = names.find(value);
  return found == names.end() ? json(value) : json(found->second);
}

json write_bits(int64_t value, const Constants& names) {
  json list = json::array();
  for (const auto& [bit, name] : names)
    if ((value & bit) != 0) list.push_back(name), value &= ~bit;
  if (value != 0) list.push_back(value);
  return list;
}

json write_bytes(const uint8_t* from, size_t count) {
  std::string text = "bytes:";
  for (size_t i = 0; i < count; ++i) {
    char two[3];
    std::snprintf(two, sizeof two, "%02x", from[i]);
    text += two;
  }
  return text;
}

std::vector<uint8_t> read_bytes(const json& from) {
  const std::string text = from.get<std::string>();
  if (text.rfind("bytes:", 0) != 0 || text.size() % 2 != 0) throw Failure(text + " is not bytes");
  std::vector<uint8_t> bytes;
  for (size_t i = 6; i < text.size(); i += 2)
    bytes.push_back(static_cast<uint8_t>(std::stoul(text.substr(i, 2), nullptr, 16)));
  return bytes;
}

/* --- Scenario --- */

Scenario::~Scenario() {
  for (; !owned_.empty(); owned_.pop_back()) owned_.back().second(owned_.back().first);
}

json Scenario::resolved(const json& value) const {
  if (is_name(value)) {
    const std::string text = value.get<std::string>();
    const size_t dot = text.find('.');
    const auto found = names_.find(text.substr(0, dot));
    if (found == names_.end()) throw Failure(text + " was not given");
    if (dot == std::string::npos) return found->second;
    std::string path = text.substr(dot);
    std::replace(path.begin(), path.end(), '.', '/');
    return found->second.at(json::json_pointer(path));
  }
  if (!value.is_structured()) return value;
  json result = value;
  for (json& item : result) item = resolved(item);
  return result;
}

void Scenario::set_handle(const std::string& name, const void* handle) {
  handles_[name] = handle;
  names_[name] = name;
}

void* Scenario::handle(const json& name) const {
  const auto found = handles_.find(name.get<std::string>());
  if (found == handles_.end()) throw Failure(name.dump() + " is no handle");
  return const_cast<void*>(found->second);  // borrowed maps are const; the functions that change maps refuse them
}

void Scenario::destroyed(const void* handle) {
  owned_.erase(std::remove_if(owned_.begin(), owned_.end(), [&](const auto& item) { return item.first == handle; }),
               owned_.end());
}

void Scenario::end() {
  for (; !owned_.empty(); owned_.pop_back()) owned_.back().second(owned_.back().first);
  for (const auto& payload : payloads_) {
    const int expected = lent_.count(payload.get()) != 0 ? 1 : 0;
    if (payload->released != expected)
      throw Failure("a callback was released " + std::to_string(payload->released) + " times instead of " +
                    std::to_string(expected));
  }
}

Payload* Scenario::payload(const Payload& from) {
  payloads_.push_back(std::make_unique<Payload>(from));
  payloads_.back()->lines = &lines_;
  return payloads_.back().get();
}

std::vector<std::string> Scenario::take_lines() {
  return std::exchange(lines_, {});
}

/* --- Call --- */

Call::Call(Scenario& scenario, const json& entry)
    : scenario_(scenario), entry_(entry), inputs_(scenario.resolved(entry.value("with", json::object()))) {
  error.struct_size = sizeof error;
}

const json& Call::input(const char* name) {
  if (!has(name)) throw Failure(std::string(name) + " is missing");
  used_.insert(name);
  return inputs_.at(name);
}

void Call::expect_size(const char* name, size_t size, size_t expected) const {
  if (size != expected)
    throw Failure(std::string(name) + " has " + std::to_string(size) + " values instead of " +
                  std::to_string(expected));
}

cairn_custom_predict_fn Call::predict(const char* name) {
  if (!has(name)) return nullptr;
  if (!is_predict(text(name))) throw Failure(text(name) + " is no function that predicts");
  return conformance_predict;
}

cairn_custom_place_fn Call::place(const char* name) {
  if (!has(name)) return nullptr;
  if (!is_place(text(name))) throw Failure(text(name) + " is no function that places");
  return conformance_place;
}

cairn_log_fn Call::log(const char* name) {
  if (!has(name)) return nullptr;
  if (text(name) != "collect") throw Failure(text(name) + " is no log");
  return conformance_log;
}

void* Call::payload() {
  Payload payload;
  payload.predict = inputs_.value("predict", ""), payload.place = inputs_.value("place", "");
  if (has("custom")) payload.rows = inputs_["custom"].value("rows", payload.rows);
  payload_ = scenario_.payload(payload);
  return payload_;
}

cairn_release_fn Call::release() {
  releases_ = true;
  return conformance_release;
}

bool Call::finish(cairn_status result, const char* last_message) {
  status = result;
  if (status == CAIRN_OK) {
    if (error.status != CAIRN_OK || error.message[0] != '\0') throw Failure("a call that succeeded wrote its error");
    if (payload_ != nullptr && releases_) scenario_.lent(payload_);
    return true;
  }
  if (error.status != status) throw Failure("the error has the status " + std::to_string(error.status));
  if (std::strcmp(error.message, last_message) != 0)
    throw Failure(std::string("the last message is \"") + last_message + "\", and the error's \"" + error.message +
                  '"');
  return false;
}

std::string Call::handle_name(const char* output) const {
  const json& given = entry_.value("gives", json::object()).value(output, json());
  if (!is_name(given)) throw Failure(std::string(output) + " is a handle and has no name");
  return given.get<std::string>();
}

void Call::give_created(const char* name, void* handle, Scenario::Destroy destroy) {
  scenario_.own(handle, destroy);
  give_lent(name, handle);
}

void Call::give_lent(const char* name, const void* handle) {
  if (handle == nullptr) throw Failure(std::string(name) + " is NULL");
  const std::string known = handle_name(name);
  scenario_.set_handle(known, handle);
  give(name, known);
}

void Call::end() const {
  for (const auto& [name, value] : inputs_.items())
    if (used_.count(name) == 0) throw Failure("the function has no input " + name);
  if (status != CAIRN_OK) return;
  const json named = entry_.value("gives", json::object());
  for (const auto& [name, value] : named.items()) {
    if (!gives.contains(name)) throw Failure("the function has no output " + name);
    if (is_name(value)) scenario_.set_name(value.get<std::string>(), gives.at(name));
  }
}

}  // namespace conformance
