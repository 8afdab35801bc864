function result = gainsmith(command, subject, varargin)
% Gains of observers and controllers by linear matrix inequalities, with the program gainsmith.
%
%   d = gainsmith('synth', problem, 'set', struct('alpha', 4))
%   c = gainsmith('verify', d, 'runs', 1000)
%   r = gainsmith('simulate', d, 'run', 3);  plot(r.t, r.e1)
%
% problem is the path of a YAML file, a struct, or a text with line breaks. In a struct a matrix is
% a matrix, or a text with a formula; a list is a cell, and a list of matrices may be an array
% (n x m x N). Where a name is none of MATLAB, such as 'x(1)', use containers.Map for the struct.
% A design d is the result of synth, optimize and bisect; the path of a gain file will do as well.
%
%   command    subject   options                                          result
%   synth      problem   set effort threads time                          verdict, objective, gains.L, margin, ...
%   optimize   problem   over largest smallest minimize tolerance refine evaluations set threads time   same
%   bisect     problem   largest smallest tolerance claims set time       same, search, samples
%   scan       problem   over show set threads time                       a column for each name, verdict
%   explain    problem   set effort time                                  verdict, conflict, ...
%   verify     design    runs probability confidence seed until strict set threads time   verdict, checks, ...
%   simulate   design    run seed step given plot set time                t, j, event, a column for each name
%   plot       either    figure output title size window set time         a cell of figures: name, systems, facts
%   compare    a struct of designs   output time                          what, names, values (texts)
%   check      either    strict set time                                  verdict, margins
%   certify    design    time                                             verdict, claims
%   report     design    output                                           the page as a text, or written to a file
%   export     design    to output float                                  the code as a text, or written to a file
%   solve      .dat-s    precision tolerance iterations threads time      status, x, X{k}, Y{k}, ...
%
% over, largest and smallest are structs: struct('T2', [0.5, 0.8]), for scan also [low, high, count].
% Verdicts 'no' and 'undecided' are results. A wrong problem is an error 'gainsmith:input', which names
% file:line:column, or the field of the struct. A fault of the program is 'gainsmith:program'.
% The program is that of the environment variable GAINSMITH, else beside this file, else that of PATH.

  if nargin < 2
    error('gainsmith:input', 'gainsmith(COMMAND, PROBLEM or DESIGN, ...): see help gainsmith');
  end
  options = options_of(command, varargin);
  folder = tempname();
  mkdir(folder);
  remove = onCleanup(@() remove_folder(folder));
  if strcmp(command, 'compare')
    result = comparison(subject, options, folder);
    return
  end
  source = source_of(subject);
  words = [{command, source.name}, words_of(command, options)];
  kept = fullfile(folder, 'kept.json');
  switch command
    case {'synth', 'optimize'}
      done = run([words, {'-o', '-'}], source, folder);
      result = design_of(done.out, done.err, source.folder);
    case 'bisect'
      done = run([words, {'--json', '-o', kept}], source, folder);
      found = jsondecode(done.out);
      text = text_of_file(kept);
      result = design_of(text, '', source.folder);
      result.samples = found.samples;
      result.search = found.result.search;
    case 'scan'
      done = run([words, {'--json'}], source, folder);
      result = scan_of(jsondecode(done.out), done.code);
    case 'verify'
      done = run([words, {'-o', kept}], source, folder);
      result = jsondecode(text_of_file(kept));
      result.summary = without_commands(done.out);
    case 'simulate'
      done = run([words, {'--json', '-o', '-'}], source, folder);
      result = run_of(jsondecode(done.out), done.err);
    case 'plot'
      done = run([words, {'--json'}], source, folder);
      result = jsondecode(done.out);
      if isstruct(result)
        result = num2cell(result);
      end
    case 'check'
      done = run([words, {'--json'}], source, folder);
      result = jsondecode(done.out);
      if ~isfield(result, 'verdict')
        result.verdict = 'yes';
      end
    case {'explain', 'certify'}
      done = run([words, {'--json'}], source, folder);
      result = jsondecode(done.out);
    case 'report'
      if ~isempty(source.text)
        write_text(fullfile(folder, 'gains.json'), source.text);
        words{2} = fullfile(folder, 'gains.json');
        source.text = '';
      end
      done = run(words, source, folder);
      result = done.out;
    case 'export'
      done = run(words, source, folder);
      if done.code ~= 0
        error('gainsmith:input', '%s', strtrim(done.err));
      end
      result = done.out;
    case 'solve'
      done = run([words, {'--json', '-o', kept}], source, folder);
      result = jsondecode(done.out);
      if exist(kept, 'file')
        point = jsondecode(text_of_file(kept));
        result.x = point.x;
        result.X = blocks_of(point.X);
        result.Y = blocks_of(point.Y);
      end
  end
end

% What differs between the designs of a struct, and the page with output.
function result = comparison(designs, options, folder)
  if ~isstruct(designs) || numel(fieldnames(designs)) < 2
    error('gainsmith:input', 'compare takes a struct of two designs or more, such as struct(''slow'', a, ''fast'', b)');
  end
  names = fieldnames(designs)';
  files = cell(size(names));
  for k = 1:numel(names)
    source = source_of(designs.(names{k}));
    files{k} = fullfile(folder, [names{k}, '.json']);
    if isempty(source.text)
      source.text = text_of_file(full_path(source.name));
    end
    write_text(files{k}, source.text);
  end
  none = struct('name', files{1}, 'text', '', 'folder', pwd(), 'keys', {{}});
  words = words_of('compare', options);
  if ~isfield(options, 'output')
    words = [words, {'-o', fullfile(folder, 'page.html')}];
  end
  done = run([{'report'}, files, words, {'--json'}], none, folder);
  table = jsondecode(done.out);
  result = struct('what', {{table.rows.what}'}, 'names', {names}, 'values', {{}});
  for k = 1:numel(table.rows)
    result.values(k, :) = reshape(table.rows(k).values(1:numel(names)), 1, []);
  end
end

% The options of each command, as above.
function known = options_known()
  search = {'tolerance', 'set', 'time'};
  known = struct( ...
    'synth', {{'set', 'effort', 'threads', 'time'}}, ...
    'optimize', {[{'over', 'largest', 'smallest', 'minimize', 'refine', 'evaluations', 'threads'}, search]}, ...
    'bisect', {[{'largest', 'smallest', 'claims'}, search]}, ...
    'scan', {{'over', 'show', 'set', 'threads', 'time'}}, ...
    'explain', {{'set', 'effort', 'time'}}, ...
    'verify', {{'runs', 'probability', 'confidence', 'seed', 'until', 'strict', 'set', 'threads', 'time'}}, ...
    'simulate', {{'run', 'seed', 'step', 'given', 'plot', 'set', 'time'}}, ...
    'plot', {{'figure', 'output', 'title', 'size', 'window', 'set', 'time'}}, ...
    'compare', {{'output', 'time'}}, ...
    'check', {{'strict', 'set', 'time'}}, ...
    'certify', {{'time'}}, ...
    'report', {{'output'}}, ...
    'export', {{'to', 'output', 'float'}}, ...
    'solve', {{'precision', 'tolerance', 'iterations', 'threads', 'time'}});
end

function options = options_of(command, pairs)
  known = options_known();
  if ~ischar(command) || ~isfield(known, command)
    error('gainsmith:input', 'there is no command ''%s''; %s', char(command), nearest(command, fieldnames(known)'));
  end
  if mod(numel(pairs), 2) ~= 0
    error('gainsmith:input', 'options are pairs of a name and a value');
  end
  options = struct();
  for k = 1:2:numel(pairs)
    name = char(pairs{k});
    if ~any(strcmp(name, known.(command)))
      error('gainsmith:input', '%s has no option ''%s''; %s', command, name, nearest(name, known.(command)));
    end
    options.(name) = pairs{k + 1};
  end
end

function text = nearest(word, known)
  distances = cellfun(@(each) edits(char(word), each), known);
  [least, k] = min(distances);
  if least <= max(1, numel(word) / 2.5)
    text = sprintf('did you mean ''%s''?', known{k});
  else
    text = ['known: ', strjoin(known, ', ')];
  end
end

% Levenshtein distance.
function d = edits(a, b)
  row = 0:numel(b);
  for i = 1:numel(a)
    before = row;
    row(1) = i;
    for j = 1:numel(b)
      row(j + 1) = min([before(j + 1) + 1, row(j) + 1, before(j) + (a(i) ~= b(j))]);
    end
  end
  d = row(end);
end

% What the program reads: a file by its name, or a text by standard input. keys are those of its lines.
function source = source_of(subject)
  source = struct('name', '-', 'text', '', 'folder', pwd(), 'keys', {{}});
  if isa(subject, 'string')
    subject = char(subject);
  end
  if isstruct(subject) && isfield(subject, 'text') && isfield(subject, 'folder')
    source.text = subject.text;
    source.folder = subject.folder;
  elseif isstruct(subject) || isa(subject, 'containers.Map')
    [lines, keys] = lines_of(subject, '', '', sprintf('\n'));
    % Without this line 'verify' and 'simulate' take a text that begins with { for a gain file.
    source.text = [sprintf('# A struct.\n'), lines{:}];
    source.keys = [{''}, keys];
  elseif ischar(subject) && any(subject == sprintf('\n'))
    source.text = subject;
  elseif ischar(subject)
    source.name = subject;
    source.folder = fileparts(full_path(subject));
  else
    error('gainsmith:input', 'a problem is a path, a struct or a text, not a %s', class(subject));
  end
end

function words = words_of(command, options)
  words = {};
  names = fieldnames(options)';
  for k = 1:numel(names)
    name = names{k};
    value = options.(name);
    if strcmp(name, 'set')
      each = fieldnames(value)';
      for i = 1:numel(each)
        words = [words, {'--set', [each{i}, '=', one_line(value.(each{i}), ['set.', each{i}])]}];
      end
    elseif any(strcmp(name, {'over', 'largest', 'smallest'})) && isstruct(value)
      each = fieldnames(value)';
      for i = 1:numel(each)
        range = arrayfun(@number, value.(each{i}), 'UniformOutput', false);
        if strcmp(command, 'bisect')
          words = [words, {['--', name], each{i}, '--in'}, range];
        else
          words = [words, {['--', name], [each{i}, '=', strjoin(range, ':')]}];
        end
      end
    elseif strcmp(name, 'given')
      words = [words, {'--given', one_line(value, 'given')}];
    elseif islogical(value)
      if value
        words{end + 1} = ['--', name];
      end
    elseif iscell(value)
      for i = 1:numel(value)
        words = [words, {['--', name], value{i}}];
      end
    elseif strcmp(name, 'output')
      words = [words, {'-o', full_path(value)}];
    elseif strcmp(name, 'plot')
      words = [words, {'--plot', full_path(value)}];
    elseif isnumeric(value)
      words = [words, {['--', name], number(value)}];
    else
      words = [words, {['--', name], char(value)}];
    end
  end
end

% Runs the program in the folder of the source; errors for the exit codes that are no results.
function done = run(words, source, folder)
  if ispc()
    error('gainsmith:program', 'gainsmith runs on Linux: in the Windows Subsystem for Linux use Octave there');
  end
  in = '/dev/null';
  if strcmp(source.name, '-')
    in = fullfile(folder, 'in');
    write_text(in, source.text);
  end
  err = fullfile(folder, 'err');
  quoted = cellfun(@quote, [{program()}, words], 'UniformOutput', false);
  line = ['cd ', quote(source.folder), ' && '];
  if ~strcmp(source.name, '-')
    line = '';
  end
  [code, out] = system([line, strjoin(quoted, ' '), ' < ', quote(in), ' 2> ', quote(err)]);
  done = struct('code', code, 'out', out, 'err', text_of_file(err));
  if code == 2
    error('gainsmith:input', '%s', placed(done.err, source));
  elseif ~any(code == [0, 1, 3])
    error('gainsmith:program', 'gainsmith %s: exit code %d\n%s', words{1}, code, strtrim(done.err));
  end
end

function found = program()
  found = getenv('GAINSMITH');
  if isempty(found)
    % PREFIX/share/octave/site/m/gainsmith.m
    prefix = fileparts(mfilename('fullpath'));
    for k = 1:4
      prefix = fileparts(prefix);
    end
    found = fullfile(prefix, 'bin', 'gainsmith');
    if ~exist(found, 'file')
      found = 'gainsmith';
    end
  elseif ~exist(found, 'file')
    error('gainsmith:program', 'GAINSMITH=%s: there is no such program', found);
  else
    found = full_path(found);
  end
  [code, ~] = system(['command -v ', quote(found)]);
  if code ~= 0
    error('gainsmith:program', ['the program gainsmith was not found: put it on PATH, ', ...
                                'or its path into the environment variable GAINSMITH']);
  end
end

% The message, with the field of a struct in place of the line of standard input.
function message = placed(err, source)
  lines = regexp(err, '^gainsmith: (.*)$', 'tokens', 'lineanchors', 'dotexceptnewline');
  message = strtrim(err);
  if ~isempty(lines)
    message = strjoin(cellfun(@(each) each{1}, lines, 'UniformOutput', false), sprintf('\n'));
  end
  place = regexp(message, '^-:(\d+):(\d+): (.*)$', 'tokens', 'once');
  if isempty(place)
    message = regexprep(message, '^--set (\w+)[:\d]*: ', 'set.$1: ');
  elseif isempty(source.keys)
    message = sprintf('<text>:%s:%s: %s', place{:});
  else
    key = source.keys{str2double(place{1})};
    message = place{3};
    if ~isempty(key)
      message = [key, ': ', message];
    end
  end
end

% A value as lines of JSON, which is YAML too, and the field of each line.
function [lines, keys] = lines_of(value, key, before, after)
  if isa(value, 'string') && isscalar(value)
    value = char(value);
  end
  if isa(value, 'containers.Map') || (isstruct(value) && isscalar(value))
    [names, values] = entries_of(value);
    lines = {[before, '{', sprintf('\n')]};
    keys = {key};
    for k = 1:numel(names)
      [more, of] = lines_of(values{k}, below(key, names{k}), [text_json(names{k}), ': '], ...
                            comma(k < numel(names)));
      lines = [lines, more];
      keys = [keys, of];
    end
    lines{end + 1} = ['}', after];
    keys{end + 1} = key;
  elseif iscell(value) || isstruct(value) || ((isnumeric(value) || islogical(value)) && ndims(value) == 3)
    if isstruct(value)
      value = num2cell(value);
    elseif ~iscell(value)
      value = squeeze(num2cell(value, [1, 2]));
    end
    lines = {[before, '[', sprintf('\n')]};
    keys = {key};
    for k = 1:numel(value)
      [more, of] = lines_of(value{k}, sprintf('%s(%d)', key, k), '', comma(k < numel(value)));
      lines = [lines, more];
      keys = [keys, of];
    end
    lines{end + 1} = [']', after];
    keys{end + 1} = key;
  elseif ischar(value)
    lines = {[before, text_json(value), after]};
    keys = {key};
  elseif islogical(value) && isscalar(value)
    words = {'false', 'true'};
    lines = {[before, words{value + 1}, after]};
    keys = {key};
  elseif isnumeric(value) || islogical(value)
    lines = {[before, matrix_json(double(full(value)), key), after]};
    keys = {key};
  else
    error('gainsmith:input', '%s: a %s is neither a number, a matrix, a text, a cell nor a struct', key, class(value));
  end
end

function [names, values] = entries_of(value)
  if isstruct(value)
    names = fieldnames(value);
    values = struct2cell(value);
  else
    names = keys(value);
    values = cellfun(@(name) value(name), names, 'UniformOutput', false);
  end
end

function text = comma(more)
  text = sprintf('\n');
  if more
    text = [',', text];
  end
end

function key = below(key, name)
  if isempty(key)
    key = name;
  else
    key = [key, '.', name];
  end
end

% A number, a flat list for a row (a column where the program expects one), or a list of rows.
function text = matrix_json(value, key)
  if isempty(value)
    error('gainsmith:input', '%s: this matrix is empty (%d x %d)', key, size(value, 1), size(value, 2));
  elseif ~isreal(value)
    error('gainsmith:input', '%s: complex numbers are not allowed', key);
  elseif ~all(isfinite(value(:)))
    [i, j] = find(~isfinite(value), 1);
    error('gainsmith:input', '%s(%d, %d): %g: a number must be finite', key, i, j, value(i, j));
  end
  digits = reshape(shortest(value(:)), size(value));
  if isscalar(value)
    text = digits{1};
  elseif size(value, 1) == 1
    text = ['[', strjoin(digits, ', '), ']'];
  else
    rows = arrayfun(@(i) ['[', strjoin(digits(i, :), ', '), ']'], 1:size(value, 1), 'UniformOutput', false);
    text = ['[', strjoin(rows, ', '), ']'];
  end
end

% The fewest of 15 to 17 digits that give the same double: 0.1 is 0.1.
function digits = shortest(values)
  digits = cell(numel(values), 1);
  left = (1:numel(values))';
  for precision = 15:17
    written = strsplit(sprintf(sprintf('%%.%dg ', precision), values(left)), ' ');
    written = written(1:end - 1)';
    digits(left) = written;
    left = left(sscanf(sprintf('%s ', written{:}), '%f') ~= values(left));
    if isempty(left)
      break
    end
  end
end

function text = number(value)
  if ~isscalar(value) || ~isfinite(value)
    error('gainsmith:input', 'expected a number');
  end
  digits = shortest(double(value));
  text = digits{1};
end

function text = text_json(value)
  value = strrep(strrep(value, '\', '\\'), '"', '\"');
  value = strrep(strrep(value, sprintf('\n'), '\n'), sprintf('\t'), '\t');
  value = strrep(value, sprintf('\r'), '\r');
  text = ['"', value, '"'];
end

% The value of --set: a text is a formula.
function text = one_line(value, key)
  if ischar(value)
    text = value;
  else
    lines = lines_of(value, key, '', '');
    text = strrep([lines{:}], sprintf('\n'), ' ');
  end
end

function design = design_of(text, summary, folder)
  file = jsondecode(text);
  design = struct('verdict', file.verdict, 'status', file.status, 'objective', NaN, 'gains', file.gains, ...
                  'unknowns', file.unknowns, 'parameters', file.parameters, 'report', struct(), ...
                  'searched', struct(), 'margin', NaN, 'file', file, 'text', text, 'folder', folder, ...
                  'summary', without_commands(summary));
  for name = {'objective', 'report', 'searched', 'gain_functions', 'search'}
    if isfield(file, name{1})
      design.(name{1}) = file.(name{1});
    end
  end
  margins = file.margins;
  if isstruct(margins) && ~isempty(margins)
    design.margin = min([margins.reached]);
  end
end

% The summary without commands about standard input.
function text = without_commands(text)
  text = regexprep(text, '[^\n]*gainsmith \w+ - [^\n]*\n', '');
end

function result = scan_of(points, code)
  verdicts = {'yes', 'no', 'undecided', 'undecided'};
  if isstruct(points)
    points = num2cell(points);
  end
  result = struct('verdict', verdicts{code + 1});
  names = fieldnames(points{1}.at)';
  for k = 1:numel(names)
    result.(names{k}) = cellfun(@(point) point.at.(names{k}), points(:));
  end
  result.verdicts = cellfun(@(point) point.verdict, points(:), 'UniformOutput', false);
  result.objective = cellfun(@(point) number_or_nan(point, 'objective'), points(:));
  if isfield(points{1}, 'figures')
    names = fieldnames(points{1}.figures)';
    for k = 1:numel(names)
      result.(names{k}) = cellfun(@(point) number_or_nan(point.figures, names{k}), points(:));
    end
  end
end

% A cell of matrices: of blocks of one size jsondecode makes one array.
function blocks = blocks_of(found)
  if iscell(found)
    blocks = found;
  else
    blocks = arrayfun(@(k) reshape(found(k, :, :), size(found, 2), size(found, 3)), 1:size(found, 1), ...
                      'UniformOutput', false);
  end
end

function value = number_or_nan(from, name)
  value = NaN;
  if isfield(from, name) && ~isempty(from.(name))
    value = from.(name);
  end
end

function result = run_of(file, summary)
  rows = file.rows;
  if iscell(rows)
    rows = vertcat_cells(rows);
  else
    rows = num2cell(rows);
  end
  result = struct('ending', file.ending, 'summary', summary, 'columns', {file.columns});
  for k = 1:numel(file.columns)
    cells = rows(:, k);
    name = matlab.lang.makeValidName(file.columns{k});
    if any(cellfun(@ischar, cells))
      result.(name) = cells;
    else
      cells(cellfun(@isempty, cells)) = {NaN};
      result.(name) = cell2mat(cells);
    end
  end
end

function cells = vertcat_cells(rows)
  cells = cell(numel(rows), numel(rows{1}));
  for i = 1:numel(rows)
    each = rows{i};
    if ~iscell(each)
      each = num2cell(each);
    end
    cells(i, :) = reshape(each, 1, []);
  end
end

function text = text_of_file(path)
  [file, message] = fopen(path, 'r', 'n', 'UTF-8');
  if file < 0
    error('gainsmith:program', '%s: %s', path, message);
  end
  text = fread(file, [1, Inf], '*char');
  fclose(file);
end

function write_text(path, text)
  file = fopen(path, 'w', 'n', 'UTF-8');
  fwrite(file, text, 'char');
  fclose(file);
end

function path = full_path(path)
  path = char(path);
  if isempty(path) || path(1) ~= '/'
    path = fullfile(pwd(), path);
  end
end

function text = quote(word)
  text = ['''', strrep(word, '''', '''\'''''''), ''''];
end

function remove_folder(folder)
  delete(fullfile(folder, '*'));
  rmdir(folder);
end
