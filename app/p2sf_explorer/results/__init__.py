"""What the panels show beyond the six main views: functions of the answer so far, without Qt."""
