#pragma once

#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/parser.hpp"

#include <algorithm>
#include <concepts>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace ponte::mavlink {

/// Hands each frame that a parser finds to those who asked for its message, as the generated struct:
///
///     Dispatcher dispatcher;
///     dispatcher.on<Attitude>([](const Attitude& attitude, const FrameView& frame) { ... });
///     parser.on_bytes(now, bytes, dispatcher);
///
/// A message is decoded once, however many ask for it, and not at all if nobody does. After the last `on` it allocates
/// nothing by itself. Handlers must not call `on`.
class Dispatcher final : public FrameSink {
 public:
  /// Calls `handler(message, frame)` for each frame that carries an `M`, after the handlers that asked before. In
  /// MAVLink 1 the extension fields are zero.
  template <Message M, std::invocable<const M&, const FrameView&> Handler>
  void on(Handler handler) {
    subject_of<M>().handlers.emplace_back(std::move(handler));
  }

  /// Calls `handler(frame, message)` for each frame, before those who asked for its message. `message` is nothing if
  /// the parser's dialect does not know it: such a frame can be forwarded, and is never decoded.
  void on_every_frame(std::function<void(const FrameView&, const MessageInfo*)> handler) {
    observers_.push_back(std::move(handler));
  }

  void on_frame(const FrameView& frame, const MessageInfo* message) override {
    for (const auto& observer : observers_) observer(frame, message);
    if (message == nullptr) return;
    for (const auto& subject : subjects_with(frame.message))
      if (subject->is(*message)) subject->deliver(frame);
  }

 private:
  struct Subject {
    explicit Subject(const MessageInfo& its_info) : info{&its_info} {}
    virtual ~Subject() = default;
    virtual void deliver(const FrameView& frame) const = 0;

    /// A dialect that was read at run time has tables of its own for the same message.
    [[nodiscard]] bool is(const MessageInfo& message) const {
      return info == &message || (info->name == message.name && info->crc_extra == message.crc_extra &&
                                  info->base_length == message.base_length && info->is_v09() == message.is_v09());
    }

    const MessageInfo* info;
  };

  template <Message M>
  struct SubjectOf final : Subject {
    SubjectOf() : Subject{M::info} {}
    void deliver(const FrameView& frame) const override {
      const auto message = decode<M>(frame);
      for (const auto& handler : handlers) handler(message, frame);
    }

    std::vector<std::function<void(const M&, const FrameView&)>> handlers;
  };

  static MessageId id_of(const std::unique_ptr<Subject>& subject) { return subject->info->id; }

  [[nodiscard]] std::span<const std::unique_ptr<Subject>> subjects_with(MessageId id) const {
    return std::ranges::equal_range(subjects_, id, {}, id_of);
  }

  template <Message M>
  SubjectOf<M>& subject_of() {
    const auto place = std::ranges::upper_bound(subjects_, M::info.id, {}, id_of);
    for (const auto& subject : subjects_with(M::info.id))
      if (subject->info == &M::info) return static_cast<SubjectOf<M>&>(*subject);
    auto subject = std::make_unique<SubjectOf<M>>();
    auto& result = *subject;
    subjects_.insert(place, std::move(subject));
    return result;
  }

  std::vector<std::unique_ptr<Subject>> subjects_;  ///< by message id, ascending
  std::vector<std::function<void(const FrameView&, const MessageInfo*)>> observers_;
};

}  // namespace ponte::mavlink
