// SPDX-License-Identifier: BSD-3-Clause
// The packets that wait to be sent: own steps and repetitions in their order, then requests. A packet that was repeated
// waits at most once, and so does the request to a teammate. Hence only own steps that nobody takes can fill the
// outbox.
#pragma once

#include "team/history.hpp"
#include "team/packet.hpp"

namespace cairn {

class Outbox {
 public:
  explicit Outbox(std::size_t max_vehicles);

  void make_room(std::size_t packets);                   // for so many calls of push(), which then do not throw
  void push(std::uint64_t number, const Bytes& bytes) {  // of an own packet
    queue_.push_back({number, bytes});
  }
  // Returns false if the request only replaced one to the same vehicle, which was still waiting. Never throws.
  bool request(const Packet& request) noexcept;
  void forget_request(std::uint64_t vehicle) noexcept;

  // The next packet; null if there is none.
  const std::vector<std::uint8_t>* next() const;
  void drop(History& history) noexcept;

 private:
  struct Waiting {
    std::uint64_t number;
    Bytes bytes;
  };
  struct Request {
    std::uint64_t vehicle = 0;
    std::vector<std::uint8_t> bytes;  // has the capacity of a request
  };

  void drop_request(std::size_t place) noexcept;

  std::vector<Waiting> queue_;
  std::size_t first_ = 0;  // of the queue
  std::vector<Request> requests_;
  std::size_t requested_ = 0;  // requests that wait; they come first
};

}  // namespace cairn
