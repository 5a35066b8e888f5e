//go:build !cairn_nosim

// SPDX-License-Identifier: BSD-3-Clause

package cairn_test

import (
	"cairn"
	"encoding/hex"
	"encoding/json"
	"errors"
	"fmt"
	"math"
	"os"
	"path/filepath"
	"reflect"
	"strconv"
	"strings"
	"testing"
)

// function is a function of the package, and the names of C of its arguments and results.
type function struct {
	call                  any
	takes, gives, changes []string
}

type constant struct {
	name  string
	value int64
}

type constantsOf struct {
	bits   bool
	values []constant
}

type object = map[string]any

// onlyForC are in no scenario: an Error replaces them.
var onlyForC = map[string]bool{"cairn_last_message": true, "cairn_sim_last_message": true}

// TestConformance replays the scenarios of tests/conformance by the public functions, and compares with the output of the
// C replayer to the last bit.
func TestConformance(t *testing.T) {
	folder, output := os.Getenv("CAIRN_CONFORMANCE"), os.Getenv("CAIRN_CONFORMANCE_OUTPUT")
	if folder == "" || output == "" {
		t.Skip("CAIRN_CONFORMANCE and CAIRN_CONFORMANCE_OUTPUT name no folders")
	}
	paths, _ := filepath.Glob(filepath.Join(folder, "*.json"))
	if len(paths) == 0 {
		t.Fatalf("%s holds no scenarios", folder)
	}
	called, calls := map[string]bool{}, 0
	for _, path := range paths {
		t.Run(strings.TrimSuffix(filepath.Base(path), ".json"), func(t *testing.T) {
			scenario, ofC := read(t, path), read(t, filepath.Join(output, filepath.Base(path)))
			entries, expected := scenario["calls"].([]any), ofC["calls"].([]any)
			if len(entries) != len(expected) {
				t.Fatalf("%d calls, and the C replayer made %d", len(entries), len(expected))
			}
			r := &replay{names: map[string]any{}}
			defer r.end(t)
			for i := range entries {
				entry := entries[i].(object)
				called[entry["call"].(string)] = true
				calls++
				got, err := r.run(entry)
				if err != nil {
					t.Fatalf("call %d, %s: %v", i, entry["call"], err)
				}
				if !reflect.DeepEqual(got, expected[i]) {
					mine, _ := json.Marshal(got)
					theirs, _ := json.Marshal(expected[i])
					t.Fatalf("call %d: Go\n%.2000s\nC\n%.2000s", i, mine, theirs)
				}
			}
		})
	}
	for name := range functions {
		if !called[name] && !onlyForC[name] {
			t.Errorf("no scenario calls %s", name)
		}
	}
	t.Logf("%d scenarios, %d calls, the same bits as in C", len(paths), calls)
}

func read(t *testing.T, path string) (value object) {
	text, err := os.ReadFile(path)
	if err == nil {
		err = json.Unmarshal(text, &value)
	}
	if err != nil {
		t.Fatal(err)
	}
	return value
}

// replay is what the calls of one scenario share: outputs that have names, and handles to close.
type replay struct {
	names   map[string]any // handles, and outputs in the form of JSON
	created []interface{ Close() error }
	lines   []any
}

func (r *replay) end(t *testing.T) {
	for i := len(r.created) - 1; i >= 0; i-- {
		if err := r.created[i].Close(); err != nil {
			t.Error(err)
		}
	}
}

// run makes a call and returns what the output of a replayer says about it.
func (r *replay) run(entry object) (got object, err error) {
	defer func() {
		if problem := recover(); problem != nil {
			err = fmt.Errorf("%v", problem)
		}
	}()
	name := entry["call"].(string)
	function, known := functions[name]
	if !known {
		return nil, errors.New("the replayer does not know this function")
	}
	with, _ := entry["with"].(object)
	call := reflect.ValueOf(function.call)
	var arguments []reflect.Value
	for i, parameter := range function.takes {
		value, given := with[parameter]
		if given {
			arguments = append(arguments, r.decode(value, call.Type().In(i)))
		} else {
			arguments = append(arguments, reflect.Zero(call.Type().In(i)))
		}
	}
	for parameter := range with {
		if !contains(function.takes, parameter) {
			return nil, fmt.Errorf("%s has no input %s", name, parameter)
		}
	}
	results := call.Call(arguments)
	got = object{"call": name}
	if failed := failure(results); failed != nil {
		var why *cairn.Error
		if !errors.As(failed, &why) {
			return nil, failed
		}
		got["status"], got["message"] = why.Status.Name(), why.Message
	} else if gives := r.results(function, arguments, results, entry); len(gives) > 0 {
		got["gives"] = gives
	}
	if len(r.lines) > 0 {
		got["log"], r.lines = r.lines, nil
	}
	return got, nil
}

func failure(results []reflect.Value) error {
	if len(results) > 0 {
		if err, ok := results[len(results)-1].Interface().(error); ok && results[len(results)-1].Kind() == reflect.Interface {
			return err
		}
	}
	return nil
}

func (r *replay) results(function function, arguments, results []reflect.Value, entry object) object {
	gives, named := object{}, object{}
	if list, ok := entry["gives"].(object); ok {
		named = list
	}
	for i, parameter := range function.gives {
		name, _ := named[parameter].(string)
		gives[parameter] = r.output(results[i], name)
	}
	for i, parameter := range function.takes {
		if contains(function.changes, parameter) {
			gives[parameter] = encode(arguments[i].Elem())
			if name, ok := named[parameter].(string); ok && strings.HasPrefix(name, "$") {
				r.names[name] = gives[parameter]
			}
		}
	}
	return gives
}

// output remembers an output that has a name, and returns it as JSON.
func (r *replay) output(value reflect.Value, name string) any {
	if handle, ok := value.Interface().(interface{ Close() error }); ok {
		r.names[name] = value.Interface()
		r.created = append(r.created, handle)
		return name
	}
	result := encode(value)
	if strings.HasPrefix(name, "$") {
		r.names[name] = result
	}
	return result
}

func contains(list []string, value string) bool {
	for _, item := range list {
		if item == value {
			return true
		}
	}
	return false
}

// lookup finds "$name", "$name.field" and "$name.0.field".
func (r *replay) lookup(path string) any {
	parts := strings.Split(path, ".")
	value, known := r.names[parts[0]]
	if !known {
		panic("nothing has the name " + parts[0])
	}
	for _, part := range parts[1:] {
		if list, ok := value.([]any); ok {
			index, err := strconv.Atoi(part)
			if err != nil {
				panic(err)
			}
			value = list[index]
		} else {
			value = value.(object)[part]
		}
	}
	return value
}

// decode makes an argument of a value of a scenario.
func (r *replay) decode(value any, kind reflect.Type) reflect.Value {
	if text, ok := value.(string); ok && strings.HasPrefix(text, "$") {
		value = r.lookup(text)
	}
	if handle := reflect.ValueOf(value); handle.Type() == kind {
		return handle
	}
	result := reflect.New(kind).Elem()
	if known, ok := constants[kind]; ok {
		result.Set(reflect.ValueOf(known.number(value)).Convert(kind))
		return result
	}
	switch kind.Kind() {
	case reflect.Func:
		result.Set(reflect.ValueOf(r.callback(value.(string), kind)))
	case reflect.Ptr:
		result = reflect.New(kind.Elem())
		result.Elem().Set(r.decode(value, kind.Elem()))
	case reflect.Struct:
		if init, ok := defaults[kind]; ok {
			result.Set(reflect.ValueOf(init).Call(nil)[0])
		}
		for name, field := range value.(object) {
			target := fieldOf(result, name)
			target.Set(r.decode(field, target.Type()))
		}
	case reflect.Array:
		list := value.([]any)
		if len(list) != kind.Len() {
			panic(fmt.Sprintf("%d values for %s", len(list), kind))
		}
		for i, item := range list {
			result.Index(i).Set(r.decode(item, kind.Elem()))
		}
	case reflect.Slice:
		if text, ok := value.(string); ok {
			bytes, err := hex.DecodeString(strings.TrimPrefix(text, "bytes:"))
			if err != nil {
				panic(err)
			}
			return reflect.ValueOf(bytes)
		}
		list := value.([]any)
		result.Set(reflect.MakeSlice(kind, len(list), len(list)))
		for i, item := range list {
			result.Index(i).Set(r.decode(item, kind.Elem()))
		}
	case reflect.Float64:
		result.SetFloat(double(value))
	case reflect.Uint64:
		number, err := strconv.ParseUint(value.(string), 10, 64)
		if err != nil {
			panic(err)
		}
		result.SetUint(number)
	default: // numbers that a double holds, booleans, texts
		result.Set(reflect.ValueOf(value).Convert(kind))
	}
	return result
}

func fieldOf(value reflect.Value, name string) reflect.Value {
	for i, field := range fields[value.Type()] {
		if field == name {
			return value.Field(i)
		}
	}
	panic(fmt.Sprintf("%s has no field %s", value.Type(), name))
}

func double(value any) float64 {
	switch v := value.(type) {
	case float64:
		return v
	case string:
		if strings.HasPrefix(v, "x") {
			bits, err := strconv.ParseUint(v[1:], 16, 64)
			if err != nil {
				panic(err)
			}
			return math.Float64frombits(bits)
		}
		number, err := strconv.ParseFloat(v, 64) // nan, inf, -inf
		if err != nil {
			panic(err)
		}
		return number
	}
	panic(fmt.Sprintf("%v is no double", value))
}

func (c constantsOf) number(value any) (result int64) {
	names := []any{value}
	if list, ok := value.([]any); ok {
		names = list
	}
	for _, name := range names {
		found := false
		for _, constant := range c.values {
			if constant.name == name {
				found = true
				result |= constant.value
				if !c.bits {
					result = constant.value
				}
			}
		}
		if !found {
			panic(fmt.Sprintf("there is no constant %v", name))
		}
	}
	return result
}

func (c constantsOf) names(number int64) any {
	list := []any{}
	for _, constant := range c.values {
		if !c.bits && constant.value == number {
			return constant.name
		}
		if c.bits && number&constant.value != 0 {
			list = append(list, constant.name)
			number &^= constant.value
		}
	}
	if number != 0 || !c.bits {
		panic(fmt.Sprintf("there is no constant %d", number))
	}
	return list
}

// encode makes JSON of an output: the form that README.md of the conformance describes.
func encode(value reflect.Value) any {
	if known, ok := constants[value.Type()]; ok {
		if value.CanInt() {
			return known.names(value.Int())
		}
		return known.names(int64(value.Uint()))
	}
	switch value.Kind() {
	case reflect.Struct:
		result := object{}
		for i, name := range fields[value.Type()] {
			if name != "" && !unrepeatable[name] {
				result[name] = encode(value.Field(i))
			}
		}
		return result
	case reflect.Array, reflect.Slice:
		if value.Type().Elem().Kind() == reflect.Uint8 {
			return "bytes:" + hex.EncodeToString(value.Bytes())
		}
		list := []any{}
		for i := 0; i < value.Len(); i++ {
			item := encode(value.Index(i))
			if inner, ok := item.([]any); ok {
				list = append(list, inner...)
			} else {
				list = append(list, item)
			}
		}
		return list
	case reflect.Float64:
		if math.IsNaN(value.Float()) {
			return "nan"
		}
		return fmt.Sprintf("x%016x", math.Float64bits(value.Float()))
	case reflect.Uint64:
		return strconv.FormatUint(value.Uint(), 10)
	case reflect.Bool:
		return value.Bool()
	case reflect.String:
		return value.String()
	}
	if value.CanInt() {
		return float64(value.Int())
	}
	return float64(value.Uint())
}
