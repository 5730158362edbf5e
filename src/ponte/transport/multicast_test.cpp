#include "ponte/core/bytes.hpp"
#include "ponte/transport/link.hpp"
#include "ponte/transport/test_witness.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace ponte::transport {
namespace {

using testing::at_port_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::must_open;
using ::testing::UnorderedElementsAre;
using testing::wait_for;
using testing::Witness;

Bytes text(std::string_view text) { return bytes_of(text); }

/// A member of a group; nothing in `link` if this machine has no way to the group.
struct Member {
  Member(Loop& loop, const std::string& endpoint) {
    auto opened = open_link(loop, *parse_endpoint(endpoint), witness);
    if (opened) {
      link = *std::move(opened);
    } else {
      why_not = to_text(opened.error());
    }
  }

  /// Only a machine without multicast is an excuse.
  [[nodiscard]] bool is_impossible_here() const {
    return why_not.find("No such device") != std::string::npos || why_not.find("no route to") != std::string::npos ||
           why_not.find("not supported") != std::string::npos;
  }

  Witness witness;
  std::unique_ptr<Link> link;
  std::string why_not;
};

#define SKIP_WITHOUT_MULTICAST(member)                                                     \
  if ((member).is_impossible_here()) GTEST_SKIP() << "no multicast: " << (member).why_not; \
  ASSERT_TRUE((member).link) << (member).why_not

TEST(MulticastLinks, ReachAllMembersOnThisMachineOurselvesIncluded) {
  Loop loop;
  Member a{loop, "udpmulticast://239.255.45.86:0?interface=lo"};
  SKIP_WITHOUT_MULTICAST(a);
  Member b{loop, at_port_of("udpmulticast://239.255.45.86", *a.link) + "?interface=lo"};
  ASSERT_TRUE(b.link) << b.why_not << ": a group may have several members on a machine";
  a.link->send(text("from a"));
  b.link->send(text("from b"));
  ASSERT_TRUE(wait_for(loop, [&] { return a.witness.datagrams.size() + b.witness.datagrams.size() == 4; }));
  EXPECT_THAT(a.witness.texts(), UnorderedElementsAre("from a", "from b"));
  EXPECT_THAT(b.witness.texts(), UnorderedElementsAre("from a", "from b"));
  EXPECT_THAT(a.witness.states, ElementsAre(LinkState::up));
  EXPECT_EQ(a.link->counters().messages_out, 1U);
  EXPECT_FALSE(a.link->peer_name(a.witness.joined.at(0)).empty());

  b.link->send_to(b.witness.joined.at(0), text("to the group all the same"));
  EXPECT_TRUE(wait_for(loop, [&] { return a.witness.datagrams.size() == 3; }));
}

TEST(MulticastLinks, DoNotHearOtherGroupsOrUnicastOnTheirPort) {
  Loop loop;
  Member ours{loop, "udpmulticast://239.255.45.86:0?interface=lo"};
  SKIP_WITHOUT_MULTICAST(ours);
  Member other{loop, at_port_of("udpmulticast://239.255.45.87", *ours.link) + "?interface=lo"};
  ASSERT_TRUE(other.link) << other.why_not;
  Witness caller_witness;
  const auto caller = must_open(loop, at_port_of("udpout://127.0.0.1", *ours.link), caller_witness);
  caller->send(text("unicast"));
  other.link->send(text("other group"));
  ours.link->send(text("our group"));
  ASSERT_TRUE(wait_for(loop, [&] { return !ours.witness.datagrams.empty() && !other.witness.datagrams.empty(); }));
  EXPECT_THAT(ours.witness.texts(), ElementsAre("our group"));
  EXPECT_THAT(other.witness.texts(), ElementsAre("other group"));
}

// On the interface that the kernel chooses; with no hops nothing leaves this machine.
TEST(MulticastLinks, KeepToThemselvesWithoutLoopback) {
  Loop loop;
  Member loud{loop, "udpmulticast://239.255.45.86:0?ttl=0"};
  SKIP_WITHOUT_MULTICAST(loud);
  Member quiet{loop, at_port_of("udpmulticast://239.255.45.86", *loud.link) + "?ttl=0&loopback=0"};
  ASSERT_TRUE(quiet.link) << quiet.why_not;
  quiet.link->send(text("unheard"));
  loud.link->send(text("heard"));
  ASSERT_TRUE(wait_for(loop, [&] { return !loud.witness.datagrams.empty() && !quiet.witness.datagrams.empty(); }));
  EXPECT_THAT(loud.witness.texts(), ElementsAre("heard"));
  EXPECT_THAT(quiet.witness.texts(), ElementsAre("heard"));
}

TEST(MulticastLinks, SpeakIpv6) {
  Loop loop;
  Member member{loop, "udpmulticast://[ff18::4586]:0?ttl=0"};
  SKIP_WITHOUT_MULTICAST(member);
  member.link->send(text("six"));
  if (member.link->counters().dropped_by(DropReason::unreachable) > 0) GTEST_SKIP() << "no IPv6 multicast route";
  ASSERT_TRUE(wait_for(loop, [&] { return !member.witness.datagrams.empty(); }));
  EXPECT_THAT(member.witness.texts(), ElementsAre("six"));
}

TEST(MulticastLinks, WantToKnowTheInterfaceOfALinkLocalGroup) {
  Loop loop;
  const Member member{loop, "udpmulticast://[ff02::4586]:0"};
  ASSERT_FALSE(member.link);
  if (member.is_impossible_here()) GTEST_SKIP() << "no IPv6: " << member.why_not;
  EXPECT_THAT(member.why_not, HasSubstr("name the interface"));
}

TEST(MulticastLinks, NameTheInterfaceThatIsNotThere) {
  Loop loop;
  const Member member{loop, "udpmulticast://239.255.45.86:0?interface=nosuch0"};
  ASSERT_FALSE(member.link);
  EXPECT_THAT(member.why_not, HasSubstr("there is no network interface nosuch0"));
}

}  // namespace
}  // namespace ponte::transport
