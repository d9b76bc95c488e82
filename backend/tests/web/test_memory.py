"""The memory of a PLC by REST."""

from tests.web.server import Server

MODEL = "CJ1M-CPU63"
SOURCE = "PROGRAM Main\nVAR level AT D100 : INT := 7; n : INT; END_VAR\n  level := level;\nEND_PROGRAM\n"


def test_words_have_names_and_a_value_is_found_where_it_is(server: Server) -> None:
    instance = server.instance("memory", MODEL, main=SOURCE)
    at = f"/api/instances/{instance}/memory"
    words = server.http.get(f"{at}/D/words?first=99&count=2").json()
    assert [(word["address"], [each["path"] for each in word["symbols"]]) for word in words] == [
        ("D99", []),
        ("D100", ["Main.level"]),
    ]
    server.http.post(f"/api/instances/{instance}/write", json={"path": "D300", "value": "16#FFFB"}).raise_for_status()
    found = server.http.get(f"{at}/D/find?value=-5").json()
    assert (found["words"], found["more"]) == ([300], False)
    assert server.http.get(f"{at}/D/find?value=7&bits=32&first=50").json()["words"] == [100]
    assert len(server.http.get(f"{at}/D/find?value=0").json()["words"]) == 200
    assert server.http.get(f"{at}?path=Main.level").json() == {"area": "D", "word": 100}
    assert server.http.get(f"{at}?path=D100.03").json() == {"area": "D", "word": 100}
    for wrong, why in (
        ("?path=Main.n", "no address"),
        ("?path=Main.leval", "has no member"),
        ("/Z/words", "no memory area 'Z'"),
        ("/D/find?value=65536", "does not fit into 16 bits"),
    ):
        refused = server.http.get(f"{at}{wrong}")
        assert refused.status_code == 422
        assert why in refused.json()["message"]
