<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de">
<context>
<name>p2sf</name>
<message><source>Undo</source><translation>Rückgängig</translation></message>
</context>
</TS>
