"""Cars with several wheels over a road that passes underneath, or on a test rig."""
