"""Tests of PLC programs in Python, without a server: `plugin.py` has the fixtures for pytest.

def test_a_battery_error_lights_the_lamp(plc):
    plc.write("start", True)
    plc.run(10)
    plc.raise_error("battery-error")
    plc.within_scans(5, "alarmLamp")
"""
