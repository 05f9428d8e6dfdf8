"""Requirements of a scene on a lens model, and a plan for the cheapest model that meets them."""

from p2sf.scene.files import read_scene
from p2sf.scene.planning.plan import Decision, Plan, plan
from p2sf.scene.planning.verify import Verdict, verify
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor

__all__ = ["Channel", "Decision", "Plan", "Scene", "Sensor", "Verdict", "plan", "read_scene", "verify"]
