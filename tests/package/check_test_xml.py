"""The Test.xml of ctest -T Test holds the measurements and pictures of the tests of depth_tests/.

    check_test_xml.py Test.xml
"""
import base64
import sys
import xml.etree.ElementTree as xml

tests = {test.findtext("Name"): test for test in xml.parse(sys.argv[1]).getroot().iter("Test") if test.find("Name") is not None}


def measured(test, name):
    found = [m.findtext("Value") for m in tests[test].iter("NamedMeasurement") if m.get("name") == name]
    assert len(found) == 1, f"{test}: {name}: {found}"
    return found[0]


assert float(measured("right", "unexplained pixels")) == 0
assert float(measured("noise", "unexplained pixels")) > 100
assert 0 < float(measured("right", "median relative bound")) < 1e-3
assert 0 < float(measured("right", "greatest relative error")) < 1e-5
assert " of 3072 pixels unexplained" in measured("noise", "Completion Status")
classes = ["equal", "within quantization", "within arithmetic", "edge", "z-fight", "missed surface", "convention", "unexplained"]
assert sum(float(measured("noise", f"{name} pixels")) for name in classes) == 64 * 48
for test in ("right", "noise"):
    for picture in ("Classes of pixels", "Differences of depth"):
        assert base64.b64decode(measured(test, picture)).startswith(b"\x89PNG\r\n"), f"{test}: {picture}"
