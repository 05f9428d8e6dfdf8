"""Files written whole or not at all, and the limits a picture file is held to before it is unpacked."""
