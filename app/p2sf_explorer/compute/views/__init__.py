"""What each panel shows beyond the main views: functions of the answer so far, without Qt."""
