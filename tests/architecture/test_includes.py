"""The map of DESIGN.md holds for this repository, and the check notices when it does not."""

from pathlib import Path

import pytest

from check_includes import MAP, violations

REPOSITORY = Path(__file__).resolve().parents[2]


@pytest.fixture
def tree(tmp_path):
    """Writes a file below src/ponte and returns the repository."""

    def write(name, text):
        path = tmp_path / "src" / "ponte" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return tmp_path

    return write


def test_this_repository_keeps_to_the_map():
    assert violations(REPOSITORY) == []


def test_a_repository_without_libraries_is_not_taken_for_a_clean_one(tmp_path):
    assert violations(tmp_path) == [f"{tmp_path}/src/ponte: no libraries are here"]


def test_the_map_has_no_cycle():
    def reaches(library, wanted, seen=frozenset()):
        return any(
            other == wanted or (other not in seen and reaches(other, wanted, seen | {other})) for other in MAP[library]
        )

    assert [library for library in MAP if reaches(library, library)] == []


@pytest.mark.parametrize(
    "library, header",
    [
        ("vsm", "ponte/autopilot/vehicle_monitor.hpp"),
        ("vsm", "ponte/dlisession/reports.hpp"),
        ("cucs", "ponte/dli/codec.hpp"),
        ("mission", "ponte/planning/route.hpp"),
        ("transport", "ponte/core/bytes.hpp"),
        ("mavlink", "ponte/mavlink/autopilots/enums.hpp"),
        ("dli", "ponte/dli/messages/catalogue.hpp"),
    ],
)
def test_an_include_down_the_map_is_fine(tree, library, header):
    assert violations(tree(f"{library}/a.cpp", f'#include "{header}"\n')) == []


@pytest.mark.parametrize(
    "library, header",
    [
        ("core", "ponte/mavlink/frame.hpp"),  # up
        ("vehicle", "ponte/autopilot/modes.hpp"),
        ("dlisession", "ponte/vsm/vsm.hpp"),
        ("mavlink", "ponte/dli/codec.hpp"),  # sideways
        ("dli", "ponte/vehicle/state.hpp"),
        ("autopilot", "ponte/dlisession/reports.hpp"),
        ("cucs", "ponte/conformance/check.hpp"),
        ("autopilot", "ponte/dli/codec.hpp"),  # down, but not their business
        ("dlisession", "ponte/mavlink/codec.hpp"),
        ("planning", "ponte/mavlink/codec.hpp"),
        ("transport", "ponte/vehicle/state.hpp"),
        ("mission", "ponte/autopilot/modes.hpp"),
        ("cucs", "ponte/autopilot/modes.hpp"),
        ("sim", "ponte/autopilot/modes.hpp"),
        ("vsm", "ponte/transport/udp_link.hpp"),
    ],
)
def test_an_include_up_or_sideways_is_named_with_its_line(tree, library, header):
    root = tree(f"{library}/a.hpp", f'#pragma once\n\n#include "{header}"\n')
    (found,) = violations(root)
    assert found.startswith(f"{root}/src/ponte/{library}/a.hpp:3: '{header}': {library} may not know ")


def test_angle_brackets_subfolders_and_tests_are_read_too(tree):
    root = tree("core/deep/a_test.cpp", "#  include <ponte/dli/codec.hpp>\n")
    (found,) = violations(root)
    assert "core/deep/a_test.cpp:1: 'ponte/dli/codec.hpp'" in found


def test_a_list_that_is_included_many_times_is_read_too(tree):
    assert len(violations(tree("vehicle/facts.def", '#include "ponte/dli/codec.hpp"\n'))) == 1


def test_an_include_cannot_climb_past_the_map(tree):
    (found,) = violations(tree("mavlink/a.cpp", '#include "../dli/codec.hpp"\n'))
    assert "never climbs" in found


def test_a_library_cannot_include_an_app(tree):
    (found,) = violations(tree("vsm/a.cpp", '#include "apps/ponte/main.hpp"\n'))
    assert "'apps/ponte/main.hpp'" in found


def test_a_library_that_is_not_on_the_map_is_named(tree):
    root = tree("helpers/a.cpp", "")
    assert violations(root) == [f"{root}/src/ponte/helpers: helpers is not on the map"]
    root = tree("core/a.cpp", '#include "ponte/helpers/a.hpp"\n')
    assert any("core/a.cpp:1: 'ponte/helpers/a.hpp': helpers is not on the map" in found for found in violations(root))


def test_a_comment_includes_nothing(tree):
    text = '// #include "ponte/dli/codec.hpp"\n/*\n#include "ponte/dli/codec.hpp"\nsteady_clock::now() */\n'
    assert violations(tree("mavlink/a.cpp", text)) == []


def test_a_comment_does_not_hide_the_line_after_it(tree):
    text = 'auto url = "http://x";\n/* two\nlines */ #include <vector>\n#include "ponte/dli/codec.hpp"\n'
    (found,) = violations(tree("mavlink/a.cpp", text))
    assert "a.cpp:4:" in found


@pytest.mark.parametrize(
    "header",
    ["boost/asio.hpp", "boost/asio/ip/udp.hpp", "asio.hpp", "thread", "sys/socket.h", "netinet/in.h", "termios.h"],
)
def test_only_transport_knows_the_outside_world(tree, header):
    (found,) = violations(tree("vsm/a.cpp", f"#include <{header}>\n"))
    assert f"a.cpp:1: '{header}' belongs to transport and apps" in found


def test_transport_may_know_the_outside_world(tree):
    text = "#include <boost/asio.hpp>\n#include <thread>\nauto now = std::chrono::steady_clock::now();\n"
    assert violations(tree("transport/a.cpp", text)) == []


@pytest.mark.parametrize(
    "call",
    [
        "std::chrono::steady_clock::now()",
        "system_clock::now()",
        "std::time(nullptr)",
        "clock_gettime(CLOCK_REALTIME, &t)",
    ],
)
def test_an_engine_that_reads_a_clock_is_named(tree, call):
    (found,) = violations(tree("vsm/a.cpp", f"\nauto now = {call};\n"))
    assert "a.cpp:2: '" in found and "as an argument" in found


LIBRARY = "ponte_library({} SOURCES a.cpp\n  DEPENDS {})\n"


@pytest.mark.parametrize(
    "library, depends",
    [
        ("vsm", "ponte::autopilot ponte::dlisession fmt::fmt"),
        ("autopilot", "ponte::mavlink_autopilots ponte::vehicle"),
        ("dlisession", "ponte::dli_messages ponte::vehicle"),
        ("core", "fmt::fmt"),
    ],
)
def test_a_link_down_the_map_is_fine(tree, library, depends):
    assert violations(tree(f"{library}/CMakeLists.txt", LIBRARY.format(library, depends))) == []


@pytest.mark.parametrize(
    "library, depends",
    [
        ("mavlink", "ponte::dli"),
        ("mavlink", "ponte::dli_messages"),
        ("dlisession", "ponte::mavlink_autopilots"),
        ("cucs", "ponte::autopilot"),
        ("mission", "ponte::autopilot"),
        ("core", "ponte::vehicle"),
        ("vsm", "ponte::transport"),
        ("vsm", "ponte_transport"),
    ],
)
def test_a_link_up_or_sideways_is_named_with_its_line(tree, library, depends):
    root = tree(f"{library}/CMakeLists.txt", LIBRARY.format(library, depends))
    (found,) = violations(root)
    assert found.startswith(f"{root}/src/ponte/{library}/CMakeLists.txt:2: '{depends}': {library} may not know ")


def test_a_link_that_is_added_later_is_read_too(tree):
    text = LIBRARY.format("mavlink", "ponte::core") + "target_link_libraries(ponte_mavlink PRIVATE ponte::dli)\n"
    (found,) = violations(tree("mavlink/CMakeLists.txt", text))
    assert "CMakeLists.txt:3: 'ponte::dli'" in found


def test_a_folder_declares_its_own_library(tree):
    (found,) = violations(tree("mavlink/CMakeLists.txt", LIBRARY.format("dli", "")))
    assert found.endswith("declares ['dli'], expected the one library mavlink")
