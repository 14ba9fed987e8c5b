"""Code that can be seen to change nothing: it makes actions of its own, and looks at paths and variables.

Most launch files in Python are no more than that. What code can do is decided by what it can get hold of: a name that
it uses is one of the words below, which are harmless whatever they are asked of, or one of its own, and no instruction
changes what is not its own. So it has nothing but its own functions, what launch files are made with, and a few
functions that only look. With what is not listed, an instruction of a later interpreter included, it may do anything.
What the text of an expression does is seen where that is evaluated: until then it is a text.

Rejected: to watch what code does, which tells it too late; to list what is harmful, of which there is always more.
"""

from __future__ import annotations

import builtins
import sys
from itertools import compress, repeat
from opcode import opmap
from operator import is_
from types import CodeType
from typing import Final, NamedTuple

MODULES: Final = frozenset(
    {
        *("os", "os.path", "pathlib", "ament_index_python", "ament_index_python.packages"),
        *("launch", "launch.actions", "launch.conditions", "launch.event_handlers", "launch.substitutions"),
        *("launch.launch_description_sources", "launch_ros", "launch_ros.actions", "launch_ros.descriptions"),
        *("launch_ros.parameter_descriptions", "launch_ros.substitutions"),
    }
)
_OF_MODULES: Final = """
    os path sep pathsep linesep curdir pardir getenv getcwd listdir environ
    abspath basename commonpath dirname exists expanduser expandvars isabs isdir isfile islink join lexists normpath
    realpath relpath split splitext
    pathlib Path PurePath absolute as_posix is_absolute is_dir is_file joinpath name parent parents parts relative_to
    resolve stem suffix with_name
    ament_index_python packages get_package_prefix get_package_share_directory get_package_share_path
    get_packages_with_prefixes PackageNotFoundError
"""
_OF_LAUNCH: Final = """
    launch actions conditions event_handlers substitutions launch_description_sources
    launch_ros descriptions parameter_descriptions
    generate_launch_description LaunchDescription Action SomeActionsType SomeSubstitutionsType Substitution
    AppendEnvironmentVariable DeclareBooleanLaunchArgument DeclareLaunchArgument EmitEvent ExecuteLocal ExecuteProcess
    GroupAction IncludeLaunchDescription LogDebug LogError LogInfo LogWarning OpaqueFunction PopEnvironment
    PopLaunchConfigurations PushEnvironment PushLaunchConfigurations RegisterEventHandler ResetEnvironment
    ResetLaunchConfigurations SetEnvironmentVariable SetLaunchConfiguration Shutdown TimerAction
    UnregisterEventHandler UnsetEnvironmentVariable UnsetLaunchConfiguration
    AllSubstitution AndSubstitution AnonName AnySubstitution Command EnvironmentVariable EqualsSubstitution FileContent
    FindExecutable IfElseSubstitution LaunchConfiguration LaunchLogDir LocalSubstitution NotEqualsSubstitution
    NotSubstitution OrSubstitution PathJoinSubstitution PathSubstitution PythonExpression StringJoinSubstitution
    TextSubstitution
    ThisLaunchFile ThisLaunchFileDir
    IfCondition UnlessCondition LaunchConfigurationEquals LaunchConfigurationNotEquals
    OnExecutionComplete OnProcessExit OnProcessIO OnProcessStart OnShutdown
    AnyLaunchDescriptionSource FrontendLaunchDescriptionSource PythonLaunchDescriptionSource
    ComposableNodeContainer LifecycleNode LoadComposableNodes Node PushROSNamespace PushRosNamespace SetParameter
    SetParametersFromFile SetRemap SetUseSimTime
    ComposableLifecycleNode ComposableNode Parameter ParameterFile ParameterValue
    ExecutableInPackage FindPackage FindPackagePrefix FindPackageShare
    add_action launch_configurations perform
"""
_OF_PYTHON: Final = """
    bool bytes dict float frozenset int list range set str tuple
    abs all any enumerate filter isinstance iter len map max min next print repr reversed round sorted sum zip
    Exception FileNotFoundError KeyError RuntimeError TypeError ValueError
    append extend get index insert items keys values
    capitalize count endswith format isdigit lower lstrip rstrip splitlines startswith strip title upper zfill
    __doc__ __file__ __name__
"""
WORDS: Final = frozenset(f"{_OF_MODULES} {_OF_LAUNCH} {_OF_PYTHON}".split())

# Of the interpreters that this was written for: what moves values about, makes new ones, calls, compares and jumps.
_INSTRUCTIONS: Final = """
    CACHE NOP RESUME EXTENDED_ARG PUSH_NULL POP_TOP COPY SWAP COPY_FREE_VARS MAKE_CELL LOAD_CLOSURE
    LOAD_CONST LOAD_FAST LOAD_FAST_CHECK LOAD_FAST_AND_CLEAR LOAD_FAST_LOAD_FAST LOAD_DEREF LOAD_NAME LOAD_GLOBAL
    STORE_FAST STORE_FAST_LOAD_FAST STORE_FAST_STORE_FAST DELETE_FAST STORE_DEREF STORE_NAME
    LOAD_ATTR LOAD_METHOD IMPORT_NAME IMPORT_FROM
    BUILD_LIST BUILD_TUPLE BUILD_SET BUILD_MAP BUILD_CONST_KEY_MAP BUILD_STRING BUILD_SLICE
    LIST_APPEND LIST_EXTEND LIST_TO_TUPLE SET_ADD SET_UPDATE MAP_ADD DICT_MERGE DICT_UPDATE
    UNPACK_SEQUENCE UNPACK_EX BINARY_SUBSCR BINARY_SLICE BINARY_OP COMPARE_OP IS_OP CONTAINS_OP
    UNARY_NEGATIVE UNARY_NOT TO_BOOL FORMAT_VALUE FORMAT_SIMPLE FORMAT_WITH_SPEC CONVERT_VALUE
    MAKE_FUNCTION SET_FUNCTION_ATTRIBUTE PRECALL CALL CALL_KW KW_NAMES CALL_FUNCTION_EX
    RETURN_VALUE RETURN_CONST RETURN_GENERATOR YIELD_VALUE GET_ITER FOR_ITER END_FOR
    JUMP_FORWARD JUMP_BACKWARD JUMP_BACKWARD_NO_INTERRUPT JUMP_IF_TRUE_OR_POP JUMP_IF_FALSE_OR_POP
    POP_JUMP_IF_TRUE POP_JUMP_IF_FALSE POP_JUMP_IF_NONE POP_JUMP_IF_NOT_NONE
    POP_JUMP_FORWARD_IF_TRUE POP_JUMP_FORWARD_IF_FALSE POP_JUMP_FORWARD_IF_NONE POP_JUMP_FORWARD_IF_NOT_NONE
    POP_JUMP_BACKWARD_IF_TRUE POP_JUMP_BACKWARD_IF_FALSE POP_JUMP_BACKWARD_IF_NONE POP_JUMP_BACKWARD_IF_NOT_NONE
    CALL_INTRINSIC_1 RAISE_VARARGS RERAISE PUSH_EXC_INFO CHECK_EXC_MATCH POP_EXCEPT LOAD_ASSERTION_ERROR
"""
_NUMBERS: Final = range(256)  # of real instructions
_HARMLESS: Final = bytes(opmap[name] for name in _INSTRUCTIONS.split() if opmap.get(name) in _NUMBERS)
_LONG, _BINARY, _IMPORT, _STORE = map(
    opmap.__getitem__, ("EXTENDED_ARG", "BINARY_OP", "IMPORT_NAME", "STORE_NAME")
)
_OR_IN_PLACE: Final = 20  # of the instructions for two values the one that changes an environment
_WITHIN, _MAKING = (
    opmap.get("CALL_INTRINSIC_1"),
    frozenset({3, 5, 6}),
)  # an error, a number, a tuple; not `import *`
# What asks something for a name, and by how many bits the number of the name is moved.
_ASKING: Final = tuple(
    (opmap[name], int(name == "LOAD_ATTR" and sys.version_info >= (3, 12)))
    for name in ("IMPORT_NAME", "IMPORT_FROM", "LOAD_ATTR", "LOAD_METHOD")
    if opmap.get(name) in _NUMBERS
)
_IS_KNOWN: Final = sys.version_info < (3, 14)  # what instructions are given


class _Code(NamedTuple):
    """A code, its instructions, and with them what each is given."""

    names: tuple[str, ...]
    instructions: bytes
    content: bytes


def changes_nothing(code: CodeType) -> bool:
    """Tell whether the code of a file, run as a module, can be seen to change nothing outside of what it makes."""
    waiting, codes, own = [code], list[_Code](), set[str]()
    for item in waiting:
        content = item.co_code
        seen = _Code(item.co_names, content[::2], content)
        if seen.instructions.translate(None, _HARMLESS) or _OR_IN_PLACE in _given(seen, _BINARY):
            return False
        if not MODULES.issuperset(_names(seen, _IMPORT)):
            return False
        if _WITHIN is not None and not _MAKING.issuperset(_given(seen, _WITHIN)):
            return False
        codes.append(seen)
        own.update(seen.names)
        waiting += compress(item.co_consts, map(is_, map(type, item.co_consts), repeat(CodeType)))
    own = own - WORDS - MODULES  # not in place: that goes through all of the words
    return _IS_KNOWN and (not own or _are_own(own, codes))


def _are_own(names: set[str], codes: list[_Code]) -> bool:
    """Tell whether these are names that a file gives to things, and asks nothing for."""
    if any(name.startswith("__") or hasattr(builtins, name) for name in names):
        return False
    having = [code for code in codes if not names.isdisjoint(code.names)]
    if any(_uses(code, asking, names, bits) for code in having for asking, bits in _ASKING):
        return False
    return all(any(_uses(code, _STORE, {name}) for code in having) for name in names)


def _uses(code: _Code, instruction: int, names: set[str], bits: int = 0) -> bool:
    """Tell whether an instruction has one of some names in a code."""
    if _LONG in code.instructions:
        return not names.isdisjoint(_names(code, instruction, bits))
    for name in names.intersection(code.names):
        index = code.names.index(name)
        for number in range(index << bits, min((index + 1) << bits, 256)):
            at = code.content.find(bytes((instruction, number)))
            while at % 2 and at > 0:  # it begins in the middle of another one
                at = code.content.find(bytes((instruction, number)), at + 1)
            if at >= 0:
                return True
    return False


def _names(code: _Code, instruction: int, bits: int = 0) -> list[str]:
    """Return the names that an instruction has in a code."""
    return [code.names[number >> bits] for number in _given(code, instruction)]


def _given(code: _Code, instruction: int) -> list[int]:
    """Return what an instruction is given in a code, each time that it is there."""
    found, place = [], code.instructions.find(instruction)
    while place >= 0:
        number, bits, before = code.content[2 * place + 1], 8, place - 1
        while before >= 0 and code.instructions[before] == _LONG:
            number |= code.content[2 * before + 1] << bits
            bits, before = bits + 8, before - 1
        found.append(number)
        place = code.instructions.find(instruction, place + 1)
    return found
