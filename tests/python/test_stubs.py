"""The type stubs name what there is, and everything has a docstring."""

import ast
import importlib.resources
import inspect
import unittest

import handway


def stub_tree():
    text = importlib.resources.files(handway).joinpath("__init__.pyi").read_text()
    return ast.parse(text)


def names_in(body):
    names = set()
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            names.add(node.target.id)
    return names


class Stubs(unittest.TestCase):
    def test_name_what_the_module_exports(self):
        self.assertEqual(names_in(stub_tree().body), set(handway.__all__))

    def test_name_the_members_of_every_class(self):
        for node in stub_tree().body:
            if not isinstance(node, ast.ClassDef) or node.name == "InputError":
                continue
            members = vars(getattr(handway, node.name))
            public = {name for name in members if not name.startswith("_")}
            stubbed = {name for name in names_in(node.body) if not name.startswith("_")}
            self.assertEqual(stubbed, public, node.name)

    def test_have_the_arguments_of_every_function(self):
        for node in ast.walk(stub_tree()):
            if not isinstance(node, ast.FunctionDef) or node.decorator_list:
                continue
            owners = [handway] + [getattr(handway, n) for n in handway.__all__]
            docs = [
                (getattr(owner, node.name).__doc__ or "")
                for owner in owners
                if hasattr(owner, node.name)
            ]
            arguments = [a.arg for a in node.args.args + node.args.kwonlyargs if a.arg != "self"]
            self.assertTrue(
                any(all(argument + ":" in doc for argument in arguments) for doc in docs),
                f"{node.name}: {arguments}",
            )

    def test_are_found_by_type_checkers(self):
        self.assertTrue(importlib.resources.files(handway).joinpath("py.typed").is_file())


class Docstrings(unittest.TestCase):
    def test_are_everywhere(self):
        for name in handway.__all__:
            if not name.startswith("_"):
                thing = getattr(handway, name)
                self.assertTrue(inspect.getdoc(thing), name)


if __name__ == "__main__":
    unittest.main()
