% The strike on an elastic beam by Octave's ode45, half of 501 cells, on equations of its own.
%
%   octave-cli octave_strike.m OUT        writes OUT.elastic: setting seconds count start end ...
%
% The acceleration is one product with a matrix computed beforehand. Steps and events are ode45's.

1;  % a script, not a function

function [values, terminal, direction] = events(y, n, branch, largest, yields)
  % Rising through zero: the branch in force ends.
  lambda = y(n + 1) - y(n);
  rate = y(2*n + 2) - y(2*n + 1);
  residual = max(largest - yields, 0);
  switch branch
    case 'separated'
      values = [lambda - residual; -1];
    case 'elastic'
      values = [residual - lambda; lambda - max(largest, yields)];
    otherwise
      values = [-rate; -1];
  end
  terminal = [1; 1];
  direction = [1; 1];
end

function rate = motion(y, n, A, p, branch, largest, yields, K, unit)
  lambda = y(n + 1) - y(n);
  residual = max(largest - yields, 0);
  % Smooth continuations: complex powers of negative numbers are cut at zero.
  whole = @(x) max(x, 0) * sqrt(max(x, 0));
  switch branch
    case 'separated'
      force = 0;
    case 'elastic'
      force = K * (whole(lambda) - whole(residual));
    otherwise
      force = K * (whole(lambda) - whole(lambda - yields));
  end
  rate = [y(n+2:end); unit^2 * (A * y(1:n+1) + p * force)];
end

warning("off", "all");  % ode45 warns at every event
out = argv(){end};
l = 0.7112; b = 0.0163; h = 0.0075; rho = 2600; E = 71.96e9; Y = 150e6; m = 0.201; R = 0.01; v0 = 15.9;
cells = 501; n = 251; dx = l / cells; last = 2e-3;
EI = E * b * h^3 / 12; area = rho * b * h * dx; coupling = rho * b * h^3 / 12 / dx;
% Displacements of the half: cells 1 to n, the last one struck, the others mirrored.
whole = sparse(cells, n);
for i = 1:cells
  whole(i, min(i, cells + 1 - i)) = 1;
end
one = ones(cells, 1);
mass = spdiags([-coupling*one, (area + 2*coupling)*one, -coupling*one], -1:1, cells, cells);
mass(1,1) -= coupling; mass(end,end) -= coupling;
bend = spdiags([one, -2*one, one], -1:1, cells, cells) / dx^2;
bend(1,:) = 0; bend(end,:) = 0;
half_mass = whole' * mass * whole;
half_stiffness = whole' * bend' * (EI * dx) * bend * whole;
A = zeros(n + 1);
A(1:n,1:n) = -full(half_mass \ half_stiffness);
load = zeros(n, 1); load(n) = 1;
p = [full(half_mass \ load); -1/m];
K = 4 * sqrt(2 * R) * E * b / (3 * h); yields = Y * h / E;
scale = v0 * (m^2 / (K^2 * v0))^(1/5); unit = scale / v0;

file = fopen([out '.elastic'], 'w');
for tolerance = [1e-6 1e-8]
  start = cputime;
  y = zeros(2*n + 2, 1); y(end) = unit * v0;
  t = 0; branch = 'elastic'; largest = 0; contacts = [0 0]; first = 1e-3;
  while t < last / unit
    options = odeset('RelTol', 1e-13, 'AbsTol', tolerance * scale, 'InitialStep', first, ...
                     'Events', @(t, y) events(y, n, branch, largest, yields));
    rate = @(t, y) motion(y, n, A, p, branch, largest, yields, K, unit);
    [ts, ys, te, ye, ie] = ode45(rate, [t last/unit], y, options);
    t = ts(end); y = ys(end,:)';
    if numel(ts) > 2, first = ts(end-1) - ts(end-2); end
    if isempty(te) || t >= last / unit, break; end
    lambda = y(n + 1) - y(n);
    which = ie(end);
    switch branch
      case 'separated'
        branch = 'elastic'; contacts(end+1,:) = [t * unit, 0];
      case 'elastic'
        if which == 1
          branch = 'separated'; contacts(end,2) = t * unit;
        else
          branch = 'plastic';
        end
      otherwise
        branch = 'elastic'; largest = lambda;
    end
  end
  fprintf(file, 'ode45,%.0e %.6g %d%s\n', tolerance, cputime - start, rows(contacts), sprintf(' %.15g', contacts'));
  fflush(file);
end
fclose(file);
