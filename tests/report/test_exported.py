"""The report as data, and the schema of it."""

import json
from dataclasses import replace

import pytest

from ptproof.report.exported import exported, exported_json, schema
from ptproof.report.read import ReadSide
from ptproof.report.site import site


@pytest.fixture(scope="module")
def data(report):
    first = report.sections[0]
    read = replace(first.claims[0], read=ReadSide("different", ("eq:sum",), "the paper: x"))
    return exported(site(replace(report, sections=(replace(first, claims=(read, *first.claims[1:])),
                                                   *report.sections[1:]))))  # fmt: skip


def check(data, form=None):
    jsonschema = pytest.importorskip("jsonschema", reason="jsonschema is not installed; it comes with the extra 'dev'")
    jsonschema.Draft202012Validator.check_schema(schema())
    return [*jsonschema.Draft202012Validator(form or schema()).iter_errors(data)]


def test_it_has_the_form_that_the_schema_says(data):
    assert check(data) == []


@pytest.mark.parametrize(
    "corrupted",
    [
        lambda data: data.pop("title"),
        lambda data: data["sections"][0]["claims"][0].update(status="green"),
        lambda data: data["sections"][0]["claims"][0].update(colour="red"),
        lambda data: data["sections"][0]["claims"][0]["evidence"].clear(),
        lambda data: data["errata"][0].update(corrections=[3]),
        lambda data: data.update(version=2),
    ],
)
def test_another_form_is_refused(data, corrupted):
    other = json.loads(json.dumps(data))
    corrupted(other)
    assert len(check(other)) == 1


def test_every_claim_and_definition_is_there_once(data, derivation):
    found = [item["id"] for section in data["sections"] for item in (*section["claims"], *section["definitions"])]
    assert sorted(found) == sorted(item.id for item in (*derivation.claims, *derivation.definitions))


def test_the_numbers_are_those_of_the_claims(data, report):
    found = [claim["status"] for section in data["sections"] for claim in section["claims"]]
    assert data["counts"] == {key: found.count(key) for key in dict.fromkeys(data["counts"])}
    assert sum(data["counts"].values()) == report.total


def test_it_can_be_written_and_read(report):
    assert json.loads(exported_json(site(report))) == exported(site(report))
