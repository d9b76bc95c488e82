"""MQTT and Sparkplug B: chosen variables are published."""
