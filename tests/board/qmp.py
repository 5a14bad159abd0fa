"""QEMU's machine protocol: commands to the machine itself, such as to unplug a device."""
import json


class Machine:
    """machine("device_del", id="usb0") does the command and answers what QEMU returns."""

    def __init__(self, connection):
        self.stream = connection.makefile("rwb", buffering=0)
        self.events = []  # their names, in order
        self.stream.readline()  # the greeting
        self("qmp_capabilities")

    def __call__(self, command, **arguments):
        arguments = {name.replace("_", "-"): value for name, value in arguments.items()}
        self.stream.write(json.dumps({"execute": command, "arguments": arguments}).encode() + b"\n")
        while line := self.stream.readline():
            said = json.loads(line)
            if "event" in said:
                self.events.append(said["event"])
            elif "error" in said:
                raise OSError(f"{command}: {said['error']['desc']}")
            else:
                return said["return"]
        raise ConnectionError("the board has ended")
