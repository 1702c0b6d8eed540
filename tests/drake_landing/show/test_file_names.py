"""Components by the names of the files of a deck."""

from drake_landing.show.file_names import names_of_files


def test_sides_issues_and_what_all_begin_with_go() -> None:
    files = ["/a/X9_WING_LH_v3.bdf", "/a/X9_WING_RH_v3.bdf", "/a/X9_fus_mesh_R02.dat"]
    files += ["/a/X9_HTP.inc", "/a/X9_vtp_final.inc", "/a/X9_engine-pyl.inc"]
    assert list(names_of_files(files).values()) == [
        *("tailplane", "wing", "wing", "engine pylon", "fuselage", "fin"),
    ]


def test_files_that_are_no_two_sides_keep_their_names() -> None:
    files = ["/a/wing_v1.bdf", "/a/wing_v2.bdf", "/a/12.bdf", "/a/props.bdf"]
    names = names_of_files(files)
    assert names["/a/wing_v1.bdf"] == "wing v1"
    assert names["/a/wing_v2.bdf"] == "wing v2"
    assert names["/a/12.bdf"] == "12"
    assert names["/a/props.bdf"] == "props"


def test_one_name_is_not_cut_away() -> None:
    assert names_of_files(["/a/wing.inc", "/a/wing_tip.inc"]) == {
        "/a/wing.inc": "wing",
        "/a/wing_tip.inc": "wing tip",
    }
