// SPDX-License-Identifier: BSD-3-Clause
// A vehicle's view of its team: what it was told, in an order that all agree on, and what it makes of that
// (docs/team.md).
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "sensor/range_bearing.hpp"
#include "team/packet.hpp"
#include "team/score.hpp"

namespace cairn {

enum class TeamMode { mono, eo_diagonal, eo_full, joint, submaps };

struct TeamOptions {
  TeamMode mode = TeamMode::joint;
  std::uint64_t vehicle = 0;       // the own name
  Index max_vehicles = 8;          // the own among them
  double max_lag = 30.0;           // s: for so long a teammate's missing packet is waited for
  double time_tolerance = 0.01;    // s: packets that are no farther apart are of one time
  std::size_t max_waiting = 4096;  // packets of one teammate that come before their turn
  std::size_t history = 1024;      // own packets that are kept for those who miss them
  bool baseline = false;           // a filter of the own vehicle alone runs beside, to tell what the team is worth
  FilterOptions<SE2> filter;       // its start is the own one
  RangeBearingParameters radar;
};

enum class Arrival { taken, waiting, request, leave, repeated, own, unknown, past, conflict, ignored, full, refused };

struct TeamCounts {
  std::uint64_t sent = 0, resent = 0, requested = 0;
  // Packets that came, by what became of them; `faulty` by PacketFault.
  std::uint64_t received = 0, taken = 0, reordered = 0, repeated = 0, own = 0, unknown = 0, past = 0, conflict = 0,
                ignored = 0, full = 0, faulty[6] = {};
  std::uint64_t lost = 0;  // that were waited for in vain
  // Of what packets hold.
  std::uint64_t matched = 0, placed = 0, rejected = 0;
  std::uint64_t sightings_used = 0, sightings_refused = 0;  // of other vehicles: no start known, or not of one time
  std::uint64_t vehicles_found = 0;                         // whose start was solved from mutual sightings
  std::uint64_t failed = 0;                                 // motions and scans that the filter refused
};

class Team {
 public:
  explicit Team(const TeamOptions& options);
  ~Team();
  const TeamOptions& options() const { return options_; }
  Filter<SE2>& filter();
  const Filter<SE2>& filter() const;

  // --- members --- throws with nothing changed
  void add(std::uint64_t vehicle);  // its start is solved from mutual sightings
  void add(std::uint64_t vehicle, const SE2& start, const Matrix3& covariance);
  void remove(std::uint64_t vehicle);
  std::vector<std::uint64_t> members() const;  // the own first

  // --- the own vehicle ---
  void propagate(const Increment<SE2>& increment);
  // What is seen at `time`, which ends a step: it becomes a packet, and all that may be taken in is. Throws where the
  // own scan could not be taken in, which is sent all the same.
  void observe(double time, std::vector<Observation> landmarks, std::vector<Observation> vehicles);
  void leave();
  const std::vector<Match>& decisions() const { return decisions_; }  // on the own scan that was taken in last
  struct Estimate {
    SE2 pose;
    Matrix3 covariance;
  };
  // Where the vehicle is now: what was taken in, and the own motion since.
  Estimate estimate(std::uint64_t vehicle) const;

  // --- packets ---
  // The next to be sent; null where there is none.
  const std::vector<std::uint8_t>* next_packet() const { return outgoing_.empty() ? nullptr : &outgoing_.front(); }
  void drop_packet() { outgoing_.pop_front(); }
  Arrival receive(const std::uint8_t* bytes, std::size_t size, PacketFault& fault);
  void ask();  // for all that is missing

  const TeamCounts& counts() const { return counts_; }
  std::size_t unsettled() const;  // own packets that wait for teammates'

  void score(const SE2& truth);
  const Score& scores() const { return score_; }

 private:
  struct Box;
  struct Fleet;
  struct Member {
    std::uint64_t id = 0;
    bool known = false;  // the filter knows where it is
    bool left = false;
    std::uint64_t next = 0;  // number of the packet to be taken in next
    double time = 0.0;       // of the last one that was
    bool started = false;
    std::optional<double> waited_from;        // where nothing ever came: since that own step
    double heard = 0.0;                       // time of the newest one that came
    std::map<std::uint64_t, Packet> waiting;  // by number
    std::deque<std::uint32_t> checksums;      // of the last ones taken in, to tell repetition from contradiction
  };
  struct Turn {
    Member* member;
    Packet packet;
  };

  Member* find(std::uint64_t vehicle);
  Member& own() { return members_.front(); }
  Member& add_member(std::uint64_t vehicle);
  bool uses_teammates() const { return options_.mode != TeamMode::mono; }
  Arrival store(Packet&& packet);
  void resend(const Packet& request);
  void send(const Packet& packet);
  void settle();
  bool next_turns(std::vector<Turn>& turns);
  void skip_gap(Member& member);
  void lose_sight(Member& member);
  void take_in(std::vector<Turn>& turns);
  void take_in_joint(std::vector<Turn>& turns);
  void take_in_extended(std::vector<Turn>& turns);
  void take_in_submaps(std::vector<Turn>& turns);
  void take_in_own(Turn& turn);
  const Filter<SE2>& filter_of(std::uint64_t vehicle) const;
  void move(Filter<SE2>& filter, const Packet& packet);
  void find_members(std::vector<Turn>& turns);
  bool find_member(Turn& lost, Turn& from);
  bool scan(Filter<SE2>& filter, int sensor, const std::vector<Observation>& landmarks,
            const std::vector<Observation>& vehicles, bool own);
  Matrix2 noise_of(const Observation& o) const;
  // An own failure is the caller's to hear of; a teammate's is counted.
  template <class Function>
  bool attempt(bool own, Function&& function) {
    try {
      function();
      return true;
    } catch (const Error& error) {
      ++counts_.failed;
      if (own) own_error_.emplace(error);
      return false;
    }
  }

  TeamOptions options_;
  std::unique_ptr<Fleet> fleet_;            // mode submaps
  std::unique_ptr<Box> box_;                // of the team; mode submaps: of the own vehicle
  std::unique_ptr<Box> baseline_;           // of the own vehicle alone
  std::deque<Member> members_;              // the own first
  std::map<std::uint64_t, Member> former_;  // that were removed or left: what was taken in once stays so
  std::vector<Increment<SE2>> pending_;     // own motions since the last packet
  std::map<std::uint64_t, std::vector<std::uint8_t>> history_;
  std::deque<std::vector<std::uint8_t>> outgoing_;
  std::vector<Match> decisions_;
  std::optional<Error> own_error_;
  TeamCounts counts_;
  Score score_;
  bool left_ = false;  // the own vehicle bade farewell
};

}  // namespace cairn
