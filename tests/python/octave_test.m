% The file gainsmith.m, as octave_test.py runs it: octave-cli octave_test.m TREE. The last line is "N passed".
1;

function check(condition, what)
  global count
  if ~condition
    error('failed: %s', what);
  end
  count = count + 1;
end

function refused(identifier, message, varargin)
  try
    gainsmith(varargin{:});
  catch problem
    check(strcmp(problem.identifier, identifier), [problem.identifier, ' ', problem.message]);
    check(~isempty(strfind(problem.message, message)), problem.message);
    return
  end
  check(false, ['no error: ', message]);
end

global count
count = 0;
tree = argv(){1};
addpath(fullfile(tree, 'apps', 'matlab'));
published = fullfile(tree, 'problems', 'ferrante-seuret-2021', 't2-0.70.yaml');
A = [0, 1; -2, -0.5];
C = [1, 0];
p = struct('problem', 'spring', 'method', 'observer', 'data', struct('A', A, 'C', C), ...
           'parameters', struct('alpha', 3), ...
           'campaign', struct('horizon', 2, 'initial', struct('x', struct('box', [-1, 1]))));

% Figures of linear systems, and designs side by side.
loop = struct('problem', 'loop', 'method', struct('let', struct('L', '5*tf(1, [1, 3, 2, 0])')), ...
              'figures', struct('loop', struct('bode', 'L'), 'modes', struct('poles', 'feedback(L)')));
figures = gainsmith('plot', loop);
check(abs(figures{1}.systems.margins.gain.value - 1.2) < 1e-12, 'a margin');
check(numel(gainsmith('plot', loop, 'figure', 'modes')) == 1, 'one figure');
picture = [tempname(), '.svg'];
gainsmith('plot', loop, 'figure', 'loop', 'output', picture, 'size', '500x300');
check(~isempty(strfind(fileread(picture), 'width="500"')), 'a picture');
delete(picture);
both = gainsmith('compare', struct('calm', gainsmith('synth', p), ...
                                   'quick', gainsmith('synth', p, 'set', struct('alpha', 4))));
row = find(strcmp(both.what, 'alpha'));
check(isequal(both.values(row, :), {'3', '4'}), 'a comparison');
refused('gainsmith:input', 'compare takes a struct', 'compare', p.problem);

% A struct, a text and values that are set.
d = gainsmith('synth', p);
check(strcmp(d.verdict, 'yes') && all(size(d.gains.L) == [2, 1]), 'a gain');
check(max(real(eig(A - d.gains.L*C))) < -3 + 1e-6, 'poles');
text = sprintf('problem: spring\nmethod: observer\ndata: {A: [[0, 1], [-2, -0.5]], C: [1, 0]}\nparameters: {alpha: 3}\n');
check(isequal(getfield(gainsmith('synth', text), 'gains'), d.gains), 'a text');
set = gainsmith('synth', p, 'set', struct('alpha', 0.1 + 0.2, 'C', '[1, 0]', 'A', [0, 1; -1, -1]));
check(set.parameters.alpha == 0.1 + 0.2 && max(real(eig([0, 1; -1, -1] - set.gains.L*C))) < -0.3, 'set');
check(~isempty(strfind(set.file.statement.problem_text, '-0.5')), 'decimals as written');
vertices = cat(3, [-1, 0.5; 0, -2], [-1, 0; 0.5, -2]);
q = gainsmith('synth', struct('problem', 'p', 'method', 'quadratic-stability', 'data', struct('A', vertices)));
P = q.unknowns.P;
check(all(eig(-(P*vertices(:, :, 2) + vertices(:, :, 2)'*P)) > 0), 'a family');
named = p;
named.problem = 'Größe "1" \ 2';
check(strcmp(getfield(gainsmith('synth', named), 'file').problem, named.problem), 'characters');
large = struct('problem', 'large', 'method', struct('data', struct('A', 'n x n'), 'report', struct('t', 'trace(A)')));
large.data.A = reshape(1:40000, 200, 200)/8;
check(gainsmith('synth', large).report.t == trace(large.data.A), 'a large matrix');
map = containers.Map();
map('x') = struct('box', [-1, 1]);
mapped = p;
mapped.campaign.initial = map;
check(strcmp(gainsmith('synth', mapped).verdict, 'yes'), 'containers.Map');

% Verdicts are results.
hidden = gainsmith('synth', p, 'set', struct('A', [1, 0; 0, 1]));
check(strcmp(hidden.verdict, 'no') && isempty(fieldnames(hidden.gains)), 'no');
check(any(strcmp('decay', gainsmith('explain', p, 'set', struct('A', [1, 0; 0, 1])).conflict.requirements)), 'explain');
undecided = gainsmith('synth', fullfile(tree, 'problems', 'reset-observer', 't2-3.3.yaml'));
check(strcmp(undecided.verdict, 'undecided'), 'undecided');
check(strcmp(gainsmith('check', d).verdict, 'yes') && strcmp(gainsmith('check', p).verdict, 'yes'), 'check');

% Runs and campaigns.
c = gainsmith('verify', d, 'runs', 40, 'seed', 5);
check(strcmp(c.verdict, 'held') && c.runs == 40 && c.violations == 0, 'verify');
check(abs(c.violation_probability_at_most - (1 - 0.05^(1/40))) < 1e-12, 'probability');
r = gainsmith('simulate', d, 'run', 3, 'step', 0.25);
check(r.t(1) == 0 && r.t(end) == 2 && all(size(r.e1) == size(r.t)), 'simulate');
check(max(abs(r.e1 - (r.x1 - r.xh1))) < 1e-12, 'columns');
e = expm((A - d.gains.L*C)*2)*[r.e1(1); r.e2(1)];
check(norm(e - [r.e1(end); r.e2(end)]) < 1e-8, 'the exact solution');
h = gainsmith('simulate', gainsmith('synth', published));
check(sum(strcmp(h.event, 'timer')) == h.j(end), 'events');

% Searches.
s = gainsmith('scan', published, 'over', struct('T2', [0.5, 0.8, 3]), 'show', {'norm(L)'});
check(max(abs(s.T2 - [0.5; 0.65; 0.8])) < 1e-12 && isequal(s.verdicts, {'yes'; 'yes'; 'no'}), 'scan');
check(isnan(s.objective(3)) && s.objective(2) > s.objective(1) && isnan(s.norm_L_(3)), 'objective of a scan');
b = gainsmith('bisect', published, 'largest', struct('T2', [0.5, 1.1]), 'tolerance', 0.05);
check(b.search.beyond - b.search.value <= 0.05 && b.searched.T2 == b.search.value, 'bisect');
check(strcmp(gainsmith('verify', b, 'runs', 10).verdict, 'held'), 'a design of bisect');
o = gainsmith('optimize', published, 'over', struct('delta', [1e-3, 1]), 'evaluations', 6);
check(strcmp(o.verdict, 'yes') && o.objective == o.search.value, 'optimize');

% Reports, code, semidefinite programs.
check(~isempty(strfind(gainsmith('report', d), '<!DOCTYPE html>')), 'report');
check(~isempty(strfind(gainsmith('export', d, 'to', 'matlab'), 'function')), 'export');
sdp = gainsmith('solve', sprintf('2\n1\n2\n1 1\n0 1 1 2 -1\n1 1 1 1 1\n2 1 2 2 1\n'));
check(strcmp(sdp.status, 'optimal') && norm(sdp.X{1} - ones(2)) < 1e-6, 'solve');

diagonal = gainsmith('solve', sprintf('1\n1\n-2\n1\n0 1 1 1 1\n0 1 2 2 -2\n1 1 1 1 1\n1 1 2 2 1\n'));
check(norm(diagonal.X{1}(:) - [0; 3]) < 1e-6, 'a diagonal block');

% Errors with their places.
wrong = p;
wrong.data.A = [0, NaN; 1, 2];
refused('gainsmith:input', 'data.A(1, 2): NaN: a number must be finite', 'synth', wrong);
wrong.data.A = [];
refused('gainsmith:input', 'data.A: this matrix is empty (0 x 0)', 'synth', wrong);
wrong.data.A = [0, 1i; 1, 2];
refused('gainsmith:input', 'data.A: complex numbers', 'synth', wrong);
wrong = p;
wrong.method = 'observr';
refused('gainsmith:input', 'method: unknown method ''observr''; did you mean ''observer''?', 'synth', wrong);
refused('gainsmith:input', '<text>:2:9: unknown method', 'synth', sprintf('problem: a\nmethod: observr\n'));
refused('gainsmith:input', 'nowhere.yaml: cannot open', 'synth', 'nowhere.yaml');
refused('gainsmith:input', 'set.alfa: the problem has no', 'synth', p, 'set', struct('alfa', 2));
refused('gainsmith:input', 'did you mean ''effort''?', 'synth', p, 'efort', 'full');
refused('gainsmith:input', 'did you mean ''synth''?', 'synht', p);
refused('gainsmith:input', 'pairs', 'synth', p, 'effort');
refused('gainsmith:input', '--runs', 'verify', d, 'runs', 'many');
setenv('GAINSMITH', '/nowhere/gainsmith');
refused('gainsmith:program', 'there is no such program', 'synth', p);
printf('%d passed\n', count);
