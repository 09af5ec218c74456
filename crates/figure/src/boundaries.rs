//! Outlines of regions of cells and border lines between them, along cell edges.
//!
//! Cells are `(column, row)`; a vertex `(i, j)` is the corner shared by the cells `(i−1..=i, j−1..=j)`.

/// A corner between cells.
pub type Vertex = (usize, usize);

/// Directions of travel: right, down, left, up (rows grow downwards here).
const STEPS: [(isize, isize); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

/// For every vertex the set of directions that leave it, one bit each.
struct Edges {
    columns: usize,
    bits: Vec<u8>,
}

impl Edges {
    fn new(columns: usize, rows: usize) -> Edges {
        Edges { columns: columns + 1, bits: vec![0; (columns + 1) * (rows + 1)] }
    }

    fn index(&self, (i, j): Vertex) -> usize {
        j * self.columns + i
    }

    fn add(&mut self, vertex: Vertex, direction: usize) {
        let index = self.index(vertex);
        self.bits[index] |= 1 << direction;
    }

    fn degree(&self, vertex: Vertex) -> u32 {
        self.bits[self.index(vertex)].count_ones()
    }

    /// Removes a direction that leaves `vertex`, straight on where possible, and returns it.
    fn take(&mut self, vertex: Vertex, heading: usize) -> Option<usize> {
        let index = self.index(vertex);
        let direction = (0..4).map(|turn| (heading + turn) % 4).find(|d| self.bits[index] & (1 << d) != 0)?;
        self.bits[index] &= !(1 << direction);
        Some(direction)
    }

    fn remove(&mut self, vertex: Vertex, direction: usize) {
        let index = self.index(vertex);
        self.bits[index] &= !(1 << direction);
    }

    fn vertex(&self, index: usize) -> Vertex {
        (index % self.columns, index / self.columns)
    }
}

fn ahead((i, j): Vertex, direction: usize) -> Vertex {
    let (di, dj) = STEPS[direction];
    (i.wrapping_add_signed(di), j.wrapping_add_signed(dj))
}

/// A path under construction that keeps only its corners.
struct Corners {
    points: Vec<Vertex>,
    heading: Option<usize>,
}

impl Corners {
    fn start(vertex: Vertex) -> Corners {
        Corners { points: vec![vertex], heading: None }
    }

    fn step(&mut self, vertex: Vertex, direction: usize) {
        if self.heading == Some(direction) {
            self.points.pop();
        }
        self.points.push(vertex);
        self.heading = Some(direction);
    }
}

/// The closed outlines of the cells that are `inside`, holes included, for an even-odd fill.
/// The last vertex of each loop is the first again.
pub fn outlines(columns: usize, rows: usize, inside: impl Fn(usize, usize) -> bool) -> Vec<Vec<Vertex>> {
    let mut edges = Edges::new(columns, rows);
    for j in 0..rows {
        for i in (0..columns).filter(|i| inside(*i, j)) {
            if j == 0 || !inside(i, j - 1) {
                edges.add((i, j), 0);
            }
            if i + 1 == columns || !inside(i + 1, j) {
                edges.add((i + 1, j), 1);
            }
            if j + 1 == rows || !inside(i, j + 1) {
                edges.add((i + 1, j + 1), 2);
            }
            if i == 0 || !inside(i - 1, j) {
                edges.add((i, j + 1), 3);
            }
        }
    }
    let mut loops = Vec::new();
    for index in 0..edges.bits.len() {
        let start = edges.vertex(index);
        while let Some(direction) = edges.take(start, 0) {
            let mut path = Corners::start(start);
            let mut at = ahead(start, direction);
            path.step(at, direction);
            let mut heading = direction;
            while at != start {
                let Some(next) = edges.take(at, heading) else { break };
                heading = next;
                at = ahead(at, heading);
                path.step(at, heading);
            }
            loops.push(path.points);
        }
    }
    loops
}

/// The lines between neighbouring cells that `differ`, merged into polylines from junction to junction.
pub fn borders(
    columns: usize,
    rows: usize,
    differ: impl Fn((usize, usize), (usize, usize)) -> bool,
) -> Vec<Vec<Vertex>> {
    let mut edges = Edges::new(columns, rows);
    for j in 0..rows {
        for i in 0..columns {
            if i + 1 < columns && differ((i, j), (i + 1, j)) {
                edges.add((i + 1, j), 1);
                edges.add((i + 1, j + 1), 3);
            }
            if j + 1 < rows && differ((i, j), (i, j + 1)) {
                edges.add((i, j + 1), 0);
                edges.add((i + 1, j + 1), 2);
            }
        }
    }
    let mut junctions = Edges::new(columns, rows);
    junctions.bits.clone_from(&edges.bits);
    let is_junction = |vertex| junctions.degree(vertex) != 2;
    let mut lines = Vec::new();
    // Open lines first, from their ends; what is left then is closed loops.
    for closed in [false, true] {
        for index in 0..edges.bits.len() {
            let start = edges.vertex(index);
            if !closed && !is_junction(start) {
                continue;
            }
            while let Some(direction) = edges.take(start, 0) {
                lines.push(follow(&mut edges, start, direction, &is_junction));
            }
        }
    }
    lines
}

/// Walks along unused edges until a junction, the start, or a dead end.
fn follow(edges: &mut Edges, start: Vertex, direction: usize, stop: &impl Fn(Vertex) -> bool) -> Vec<Vertex> {
    let mut path = Corners::start(start);
    let (mut at, mut heading) = (start, direction);
    loop {
        at = ahead(at, heading);
        edges.remove(at, (heading + 2) % 4);
        path.step(at, heading);
        if at == start || stop(at) {
            return path.points;
        }
        match edges.take(at, heading) {
            Some(next) => heading = next,
            None => return path.points,
        }
    }
}
